//! Activity in plain numbers: the specification of `shaders/field/gas_activity.wgsl`.

/// Which tiles there is work in: those that are faster than `stillness` or were touched, and those beside them.
pub fn active(tiles: [usize; 2], periodic: [bool; 2], motion: &[f32], touched: &[bool], stillness: f32) -> Vec<bool> {
    let [columns, rows] = tiles.map(|tiles| tiles as i64);
    let index = |x: i64, y: i64| {
        let along = |at: i64, size: i64, repeats: bool| {
            if repeats { Some(at.rem_euclid(size)) } else { (0..size).contains(&at).then_some(at) }
        };
        Some((along(y, rows, periodic[1])? * columns + along(x, columns, periodic[0])?) as usize)
    };
    let moves = |tile: usize| motion[tile] > stillness || touched[tile];
    (0..rows)
        .flat_map(|y| (0..columns).map(move |x| (x, y)))
        .map(|(x, y)| (-1..=1).any(|dy| (-1..=1).any(|dx| index(x + dx, y + dy).is_some_and(moves))))
        .collect()
}
