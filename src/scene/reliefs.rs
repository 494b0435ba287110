//! Reliefs: further ones beside the scene's own, each with a field, a place and a material of its own.

use glam::{DMat3, DVec3, Mat4};
use serde::{Deserialize, Serialize};

use super::{Base, FieldSettings, Material, Mesh, Plane, Scene, exactly};
use crate::surface::ray_map::Placement;

/// How many reliefs there may be beside the scene's own. Each has the textures of a whole field, and every pixel that sees its
/// rectangle traces it.
pub const RELIEFS_MAX: usize = 7;

/// A still relief beside the scene's own, `[[reliefs]]`: traced by the scene's technique, lit by its lights.
///
/// It begins as the plane does, level, u along +x and v along +z. Then it turns in its own plane (roll), is tipped up about the x axis
/// (pitch: at 90° it is a wall that faces +z, with the top of its image above), turns about the vertical (yaw: at 90° that wall faces
/// +x), and moves to its position.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Relief {
    /// Its name, for the panel.
    pub name: String,
    /// The middle of its reference surface, metres.
    #[serde(deserialize_with = "exactly")]
    pub position_metres: [f32; 3],
    /// Turn about the vertical, degrees, from +z toward +x.
    pub yaw_degrees: f32,
    /// Tip about the horizontal, degrees: 0 lies, 90 stands, 180 hangs.
    pub pitch_degrees: f32,
    /// Turn in its own plane, degrees.
    pub roll_degrees: f32,
    /// Its field's size and what lies beyond its border.
    pub field: FieldSettings,
    /// The plane that carries its field.
    pub plane: Plane,
    /// Its heights.
    pub base: Base,
    /// What it is made of.
    pub material: Material,
    /// The mesh that carries it; absent: its plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<Mesh>,
}

impl Relief {
    /// Where its plane lies in the world.
    pub fn placement(&self) -> Placement {
        let [yaw, pitch, roll] = [self.yaw_degrees, self.pitch_degrees, self.roll_degrees].map(|angle| turn(angle.into()));
        let about_y = |[sin, cos]: [f64; 2]| DMat3::from_cols(DVec3::new(cos, 0.0, -sin), DVec3::Y, DVec3::new(sin, 0.0, cos));
        let about_x = |[sin, cos]: [f64; 2]| DMat3::from_cols(DVec3::X, DVec3::new(0.0, cos, sin), DVec3::new(0.0, -sin, cos));
        let turned = about_y(yaw) * about_x(pitch) * about_y(roll);
        let origin = DVec3::from(self.position_metres.map(f64::from));
        Placement { origin, u: turned.x_axis, v: turned.z_axis, up: turned.y_axis }
    }

    /// From where its mesh would lie about the origin to where it lies.
    pub fn world_from_own(&self) -> Mat4 {
        let Placement { origin, u, v, up } = self.placement();
        let [x, y, z] = [u, up, v].map(|axis| axis.as_vec3().extend(0.0));
        Mat4::from_cols(x, y, z, origin.as_vec3().extend(1.0))
    }

    /// The scene that it would be by itself, about the origin: what makes heights and pictures of a scene makes them of it.
    pub fn alone(&self, scene: &Scene) -> Scene {
        Scene {
            seed: scene.seed,
            field: self.field.clone(),
            plane: self.plane.clone(),
            base: self.base.clone(),
            trace: scene.trace.clone(),
            lod: scene.lod.clone(),
            light: scene.light.clone(),
            lights: scene.lights.clone(),
            material: self.material.clone(),
            mesh: self.mesh.clone(),
            balls: scene.balls.clone(),
            camera: scene.camera.clone(),
            ..Scene::default()
        }
    }
}

/// Sine and cosine of an angle in degrees; of right angles exactly.
fn turn(degrees: f64) -> [f64; 2] {
    match degrees.rem_euclid(360.0) {
        0.0 => [0.0, 1.0],
        90.0 => [1.0, 0.0],
        180.0 => [0.0, -1.0],
        270.0 => [-1.0, 0.0],
        other => <[f64; 2]>::from(other.to_radians().sin_cos()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_stands_upright_and_faces_where_it_is_turned() {
        let wall = Relief { pitch_degrees: 90.0, position_metres: [1.0, 2.0, 3.0], ..Relief::default() };
        let Placement { origin, u, v, up } = wall.placement();
        assert_eq!((origin, u, v, up), (DVec3::new(1.0, 2.0, 3.0), DVec3::X, DVec3::NEG_Y, DVec3::Z));
        let Placement { u, v, up, .. } = Relief { yaw_degrees: 90.0, ..wall.clone() }.placement();
        assert_eq!((u, v, up), (DVec3::NEG_Z, DVec3::NEG_Y, DVec3::X));
        // Its image turns upside down in its own plane.
        let Placement { u, v, up, .. } = Relief { roll_degrees: -180.0, ..wall }.placement();
        assert_eq!((u, v, up), (DVec3::NEG_X, DVec3::Y, DVec3::Z));
    }

    #[test]
    fn axes_stay_at_right_angles_and_handed_as_the_planes_are() {
        for angles in [[0.0, 0.0, 0.0], [33.0, -71.0, 250.0], [-3600.0, 12.5, 0.1], [181.0, 89.0, -45.0]] {
            let [yaw_degrees, pitch_degrees, roll_degrees] = angles;
            let relief = Relief { yaw_degrees, pitch_degrees, roll_degrees, ..Relief::default() };
            let Placement { u, v, up, .. } = relief.placement();
            assert!((v.cross(u) - up).length() < 1e-14 && (u.length() - 1.0).abs() < 1e-14, "{angles:?}: {u} {v} {up}");
        }
        assert_eq!(Relief::default().placement(), Placement::default());
    }
}
