//! Unknown names: the sentence that lists the known ones and suggests the nearest.

/// Says that `name` is no `kind` ("technique", "scene"), which ones there are, and which one was probably meant.
pub fn unknown(kind: &str, name: &str, known: &[&str]) -> String {
    let list = enumerate(known, "and");
    if name.is_empty() {
        return format!("the name of a {kind} is missing: known are {list}");
    }
    match nearest(name, known) {
        Some(nearest) => format!("unknown {kind} `{name}`: did you mean `{nearest}`, of {list}?"),
        None => format!("unknown {kind} `{name}`: known are {list}"),
    }
}

/// The known name nearest to `name`, if any is near enough to be a slip of the finger.
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let name = name.to_lowercase();
    // One slip, and one more for every four letters: "pmo" is pom. Or the beginning of it, nearly: "bulet" is bullet-wall.
    let slips = 1 + name.chars().count() / 4;
    known
        .iter()
        .map(|&candidate| (strsim::damerau_levenshtein(&name, candidate), strsim::jaro_winkler(&name, candidate), candidate))
        .filter(|&(distance, likeness, _)| distance <= slips || likeness > 0.8)
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(_, _, candidate)| candidate)
}

/// `a, b and c`, or with another conjunction.
pub fn enumerate(names: &[&str], conjunction: &str) -> String {
    match names {
        [] => String::new(),
        [only] => (*only).to_owned(),
        [all @ .., last] => format!("{} {conjunction} {last}", all.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_finds_its_name() {
        let known = ["normal", "pom", "exact"];
        for (slip, meant) in [("exat", "exact"), ("pmo", "pom"), ("Normal", "normal"), ("norml", "normal")] {
            assert_eq!(nearest(slip, &known), Some(meant), "{slip}");
        }
        assert_eq!(nearest("bulet", &["ripples", "bullet-wall", "relief"]), Some("bullet-wall"));
        assert_eq!(nearest("zzz", &known), None);
        assert_eq!(nearest("", &known), None);
    }

    #[test]
    fn the_sentence_lists_what_there_is() {
        let sentence = unknown("technique", "exat", &["normal", "pom", "exact"]);
        assert_eq!(sentence, "unknown technique `exat`: did you mean `exact`, of normal, pom and exact?");
        assert_eq!(unknown("scene", "zzz", &["only"]), "unknown scene `zzz`: known are only");
    }
}
