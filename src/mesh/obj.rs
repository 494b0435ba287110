//! Wavefront OBJ: positions, texture coordinates, normals, faces and the names of materials.
//!
//! Read here rather than by a crate so that an error says its line, and a face without texture coordinates is one. Texture
//! coordinates count up in OBJ and down in field space: v becomes 1 − v. A quad is cut along its shorter diagonal that keeps both
//! halves facing alike, a larger polygon into a fan about its first vertex: it must be convex. Where a face of a material lacks
//! normals, all of that material's are computed, smooth across edges where faces turn by less than 45°. Points and lines are left out
//! with a note; smoothing groups, curves and colours mean nothing here.

use std::collections::HashMap;

use glam::{Vec2, Vec3};

use super::assemble::{Piece, assemble, check_count};
use super::{Mesh, Unfit};

/// A vertex of a face: places of its position, texture coordinates and normal.
type Corner = (u32, u32, Option<u32>);

/// cos 45°.
const CREASE_COSINE: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// What some editors write before UTF-8; it is no part of the first line.
const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

#[derive(Default)]
struct Reader {
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    materials: HashMap<String, usize>,
    pieces: Vec<(Piece, HashMap<Corner, u32>)>,
    material: String,
    triangles: usize,
    lines_and_points: usize,
}

/// The mesh in the bytes of such a file.
///
/// # Errors
///
/// The text is malformed, or the mesh is not one to carry a height field.
pub fn parse(name: &str, bytes: &[u8]) -> Result<Mesh, Unfit> {
    let mut reader = Reader::default();
    // Names may be in any encoding; all that counts is ASCII.
    let text = String::from_utf8_lossy(bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes));
    let mut lines = text.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        let mut line = line.trim_end().to_owned();
        while line.ends_with('\\') {
            line.pop();
            line.push(' ');
            line.push_str(lines.next().map_or("", |(_, more)| more.trim_end()));
        }
        reader.line(&line).map_err(|problem| Unfit(format!("has in line {} {problem}", number + 1)))?;
        check_count(reader.triangles)?;
    }
    if reader.lines_and_points > 0 {
        log::warn!("{name}: {} lines and points are left out, only faces count", reader.lines_and_points);
    }
    let pieces = reader.pieces.into_iter().map(|(mut piece, _)| {
        if piece.normals.len() < piece.positions.len() {
            piece.normals.clear();
        }
        piece
    });
    assemble(name, pieces.collect(), None)
}

impl Reader {
    fn line(&mut self, line: &str) -> Result<(), String> {
        let content = line.split('#').next().unwrap_or_default();
        let mut words = content.split_whitespace();
        match words.next() {
            Some("v") => {
                let position = Vec3::from_array(numbers(words, "a position is `v X Y Z`")?);
                if !position.is_finite() {
                    return Err(format!("the position {position}, which is not finite: repair the mesh"));
                }
                self.positions.push(position);
            }
            Some("vt") => {
                let [u, v] = numbers(words, "texture coordinates are `vt U V`")?;
                self.uvs.push(Vec2::new(u, 1.0 - v));
            }
            Some("vn") => self.normals.push(Vec3::from_array(numbers(words, "a normal is `vn X Y Z`")?)),
            Some("f") => self.face(words)?,
            Some("usemtl") => self.material = words.collect::<Vec<_>>().join(" "),
            Some("l" | "p") => self.lines_and_points += 1,
            _ => {}
        }
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let corners = words.map(|word| self.corner(word)).collect::<Result<Vec<_>, _>>()?;
        if corners.len() < 3 {
            return Err(format!("a face of {} vertices, and it takes three: repair the mesh", corners.len()));
        }
        self.triangles += corners.len() - 2;
        let at = |corner: usize| self.positions[corners[corner].0 as usize];
        let is_cut_across = corners.len() == 4 && {
            let faces = |a, b, c| (at(b) - at(a)).cross(at(c) - at(a));
            let [along, across] =
                [faces(0, 1, 2).dot(faces(0, 2, 3)), faces(0, 1, 3).dot(faces(1, 2, 3))].map(|agreement| agreement > 0.0);
            let is_shorter = at(1).distance_squared(at(3)) < at(0).distance_squared(at(2));
            if along == across { is_shorter } else { across }
        };
        let count = self.pieces.len();
        let place = *self.materials.entry(self.material.clone()).or_insert(count);
        if place == count {
            let piece = Piece { material: self.material.clone(), crease_cosine: CREASE_COSINE, ..Piece::default() };
            self.pieces.push((piece, HashMap::new()));
        }
        let (piece, known) = &mut self.pieces[place];
        let places: Vec<u32> = corners
            .iter()
            .map(|&corner| {
                *known.entry(corner).or_insert_with(|| {
                    let (position, uv, normal) = corner;
                    piece.positions.push(self.positions[position as usize]);
                    piece.uvs.push(self.uvs[uv as usize]);
                    piece.normals.extend(normal.map(|normal| self.normals[normal as usize]));
                    #[expect(clippy::cast_possible_truncation, reason = "the number of triangles is checked above")]
                    let place = (piece.positions.len() - 1) as u32;
                    place
                })
            })
            .collect();
        if is_cut_across {
            piece.triangles.extend([[places[0], places[1], places[3]], [places[1], places[2], places[3]]]);
        } else {
            piece.triangles.extend(places[1..].windows(2).map(|edge| [places[0], edge[0], edge[1]]));
        }
        Ok(())
    }

    /// `V/VT`, or `V/VT/VN`; from 1, or from the last if negative.
    fn corner(&self, word: &str) -> Result<Corner, String> {
        let mut parts = word.split('/');
        let position = place(parts.next().unwrap_or_default(), self.positions.len(), "position")?;
        let uv = match parts.next() {
            None | Some("") => {
                return Err("a face without texture coordinates: unwrap the mesh in the program that made it and save them too"
                    .to_owned());
            }
            Some(part) => place(part, self.uvs.len(), "texture coordinate")?,
        };
        let normal = match parts.next() {
            None | Some("") => None,
            Some(part) => Some(place(part, self.normals.len(), "normal")?),
        };
        Ok((position, uv, normal))
    }
}

/// The first numbers of a line.
fn numbers<'a, const N: usize>(mut words: impl Iterator<Item = &'a str>, form: &str) -> Result<[f32; N], String> {
    let mut values = [0.0; N];
    for value in &mut values {
        let word = words.next().ok_or_else(|| format!("too few numbers: {form}"))?;
        *value = word.parse().map_err(|_| format!("`{word}` where a number must be: {form}"))?;
    }
    Ok(values)
}

/// A place counted from 1, or from the last if negative, as one from 0.
fn place(text: &str, count: usize, what: &str) -> Result<u32, String> {
    let number: i64 =
        text.parse().map_err(|_| format!("`{text}` where the number of a {what} must be: a face is `f V/VT/VN …`"))?;
    let count = i64::try_from(count).unwrap_or(i64::MAX);
    let place = if number > 0 { number - 1 } else { count.saturating_add(number) };
    match u32::try_from(place) {
        Ok(place) if i64::from(place) < count => Ok(place),
        _ => Err(format!("a face with {what} {number}, and there are {count} so far: save the mesh anew")),
    }
}
