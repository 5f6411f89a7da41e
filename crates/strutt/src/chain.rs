//! A chain of n pendulums in absolute angles, with masses and lengths of their own: a model of any size for trying and timing.

use std::fmt::Write;

/// Longest chain that is written.
pub const LONGEST: usize = 1000;

/// The model file of n pendulums; n = 10 is the file in the gallery.
pub fn model(n: usize) -> String {
    let mut out = String::new();
    // writing to a string does not fail
    let _ = write_model(&mut out, n);
    out
}

fn write_model(out: &mut String, n: usize) -> std::fmt::Result {
    writeln!(out, "title = {{ en = \"Chain of {n} pendulums\", ru = \"Цепь из {n} маятников\" }}\n")?;
    writeln!(out, "[description]")?;
    writeln!(out, "en = \"Point masses on massless rods, hinged one to the next; every angle is counted from the vertical.\"")?;
    writeln!(
        out,
        "ru = \"Точечные массы на невесомых стержнях, последовательно соединённых шарнирами; все углы отсчитываются от вертикали.\""
    )?;
    writeln!(out, "\n[parameters]")?;
    (1..=n).try_for_each(|i| writeln!(out, "m_{i} = \"1 kg\""))?;
    (1..=n).try_for_each(|i| writeln!(out, "l_{i} = \"0.1 m\""))?;
    writeln!(out, "\n[coordinates]")?;
    (1..=n).try_for_each(|i| writeln!(out, "phi_{i} = {{ unit = \"rad\", start = \"30 deg\", symbol = \"φ_{i}\" }}"))?;
    writeln!(out, "\n[points]")?;
    (1..=n).try_for_each(|i| writeln!(out, "A_{i} = {{ on = \"link_{i}\", at = [\"0\", \"-l_{i}\"] }}"))?;
    (1..=n).try_for_each(|i| link(out, i))?;
    writeln!(out, "\n[outputs]")?;
    writeln!(out, "E = {{ value = \"kinetic_energy() + potential_energy()\", label = {{ en = \"energy\", ru = \"полная энергия\" }} }}")?;
    writeln!(out, "\n[[study]]\nkind = \"equations\"")?;
    writeln!(out, "\n[[study]]\nkind  = \"simulate\"\nuntil = \"2 s\"")?;
    match n {
        1 => writeln!(out, "plot  = [\"phi_1\", \"E\"]"),
        _ => writeln!(out, "plot  = [[\"phi_1\", \"phi_{n}\"], \"E\"]"),
    }
}

fn link(out: &mut String, i: usize) -> std::fmt::Result {
    writeln!(out, "\n[bodies.link_{i}]\nlabel = {{ en = \"link {i}\", ru = \"звено {i}\" }}")?;
    if i > 1 {
        writeln!(out, "origin = \"A_{}\"", i - 1)?;
    }
    writeln!(out, "angle  = \"phi_{i}\"\nmass   = \"m_{i}\"\ncenter = [\"0\", \"-l_{i}\"]")
}

#[cfg(test)]
mod tests {
    #[test]
    fn ten_links_are_the_gallery_file() {
        let example = crate::gallery::find("n-pendulum").unwrap();
        assert_eq!(super::model(10), example.text);
    }
}
