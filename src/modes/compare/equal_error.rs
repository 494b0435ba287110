//! At equal error: with how many samples a technique comes as near to the truth as half a texel, and what that costs beside `exact`.

use std::fmt::Write as _;

use super::table::Row;
use crate::modes::statistics::counted;
use crate::surface::Technique;

/// The error at which costs are compared: RMS of positions, texels.
pub const TEXELS: f64 = 0.5;

/// A sentence for each technique of one camera and field whose samples were swept. Nothing where nothing was swept, or `exact` is
/// not there to be compared with.
pub fn sentences(rows: &[Row]) -> String {
    let mut text = String::new();
    let Some(exact) = rows.iter().find(|row| row.technique == Technique::Exact) else { return text };
    let mut techniques: Vec<Technique> = rows.iter().filter(|row| row.samples.is_some()).map(|row| row.technique).collect();
    techniques.dedup();
    for technique in techniques {
        let swept = rows.iter().filter(|row| row.technique == technique && row.shadow == exact.shadow);
        let most = swept.clone().filter_map(|row| row.samples).max().unwrap_or(0);
        // Counts ascend: the first is the fewest.
        let near = swept.clone().find(|row| row.position_error_texels.rms <= TEXELS);
        let name = technique.name();
        // Writing to a String cannot fail.
        let _ = match near {
            None => writeln!(text, "half a texel RMS: {name} is not as near with {}", counted(most.into(), "sample")),
            Some(near) => {
                let samples = counted(near.samples.unwrap_or(0).into(), "sample");
                let costs = match (near.surface_ms, exact.surface_ms) {
                    (Some(near), Some(exact)) => {
                        format!("{near:.2} ms, exact takes {exact:.2} ms, {:.2} of it", exact / near)
                    }
                    _ => {
                        let [near, exact] = [near, exact].map(|row| row.steps_per_pixel.mean);
                        format!("{near:.1} steps a pixel, exact takes {exact:.1}")
                    }
                };
                writeln!(text, "half a texel RMS: {name} needs {samples} and {costs}")
            }
        };
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::table::tests::row;
    use super::*;

    fn swept(samples: u32, rms: f64, surface_ms: Option<f64>) -> Row {
        Row { samples: Some(samples), surface_ms, ..row(Technique::Pom, rms) }
    }

    #[test]
    fn the_fewest_samples_that_come_near_enough_are_compared() {
        let exact = row(Technique::Exact, 0.0);
        let rows = [swept(8, 2.0, Some(4.0)), swept(16, 0.5, Some(10.0)), swept(32, 0.1, Some(20.0)), exact.clone()];
        assert_eq!(sentences(&rows), "half a texel RMS: pom needs 16 samples and 10.00 ms, exact takes 8.00 ms, 0.80 of it\n");
        assert_eq!(sentences(&rows[..3]), "");
        let far = [swept(8, 2.0, Some(4.0)), exact.clone()];
        assert_eq!(sentences(&far), "half a texel RMS: pom is not as near with 8 samples\n");
        let one = [swept(1, 0.2, Some(4.0)), exact.clone()];
        assert_eq!(sentences(&one), "half a texel RMS: pom needs 1 sample and 4.00 ms, exact takes 8.00 ms, 2.00 of it\n");
        let untimed = [swept(8, 0.2, None), exact];
        assert_eq!(sentences(&untimed), "half a texel RMS: pom needs 8 samples and 10.3 steps a pixel, exact takes 10.3\n");
    }

    #[test]
    fn nothing_is_said_where_nothing_was_swept() {
        assert_eq!(sentences(&[row(Technique::Pom, 0.2), row(Technique::Exact, 0.0)]), "");
    }
}
