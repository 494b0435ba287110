//! The panel's group of the material: what it is made of, and what light does to it.

use egui::Ui;

use super::Panel;
use super::widgets::{Control, choice, colour, group, value};
use crate::surface::{Albedo, Shading};

impl Panel {
    pub(super) fn material_group(&mut self, ui: &mut Ui) {
        let (material, was) = (&mut self.scene.material, &self.original.material);
        let changed = material != was;
        let reset = group(ui, "Material", false, Some(changed), |ui| {
            choice(ui, "Albedo", "What the surface is made of", &mut material.albedo, was.albedo, Albedo::ALL, Albedo::label);
            colour(ui, "Tint", "Multiplies the albedo, linear", &mut material.tint, was.tint);
            if material.albedo == Albedo::Glass {
                let tip = "Index of refraction: water has 1.33, glass 1.5, diamond 2.4";
                let control = Control::new("Refraction", "", 1.0, 2.5).tip(tip);
                value(ui, &control, &mut material.refractive_index, was.refractive_index);
            }
            const MODEL: &str = "What light does to the surface";
            choice(ui, "Light model", MODEL, &mut material.model, was.model, Shading::ALL, Shading::label);
            let control = Control::new("Highlight", "", 0.0, 1.0).tip("Strength of the highlight");
            value(ui, &control, &mut material.specular, was.specular);
            match material.model {
                Shading::Phong => {
                    let tip = "How small the highlight is";
                    let control = Control::new("Shininess", "", 1.0, 512.0).decimals(0).logarithmic().tip(tip);
                    value(ui, &control, &mut material.shininess, was.shininess);
                }
                Shading::Ggx => {
                    let control = Control::new("Roughness", "", 0.0, 1.0).tip("0 is a mirror, 1 matt");
                    value(ui, &control, &mut material.roughness, was.roughness);
                    let tip = "0 is stone, wood, glaze; 1 is metal, whose colour is that of its highlight";
                    let control = Control::new("Metallic", "", 0.0, 1.0).tip(tip);
                    value(ui, &control, &mut material.metallic, was.metallic);
                }
            }
            let control = Control::new("Reflection", "", 0.0, 1.0).tip("How much of the sky it mirrors");
            value(ui, &control, &mut material.reflection, was.reflection);
        });
        if reset {
            *material = was.clone();
        }
    }
}
