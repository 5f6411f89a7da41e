//! Rolled-steel profiles by their names. The table `profiles.csv` names its sources.

use std::sync::OnceLock;
use symbolic::Rational;

/// Form of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// I-beam, web along y.
    Beam,
    /// Channel, web along y, flanges towards +x.
    Channel,
    /// Equal angle, legs towards +x and +y.
    Angle,
}

/// A profile; sizes in metres, moments about the centroid in m⁴.
#[derive(Clone, Debug)]
pub struct Profile {
    /// Name: `I20`, `C20U`, `C20P`, `L100x10`.
    pub name: String,
    /// `GOST 8239-89`.
    pub standard: String,
    /// Form.
    pub kind: Kind,
    /// Height, width, web, flange, inner fillet, toe radius.
    pub sizes: [f64; 6],
    /// Slope of the inner faces of the flanges, tangent.
    pub slope: f64,
    /// Area as printed.
    pub area: Rational,
    /// ∫ y² dA.
    pub xx: Rational,
    /// ∫ x² dA.
    pub yy: Rational,
    /// ∫ x y dA.
    pub xy: Rational,
    /// Centroid from the back of the web or of the legs; half the width of a beam.
    pub z0: f64,
}

const TABLE: &str = include_str!("profiles.csv");

fn all() -> &'static [Profile] {
    static PROFILES: OnceLock<Vec<Profile>> = OnceLock::new();
    PROFILES.get_or_init(|| TABLE.lines().filter(|l| !l.starts_with('#')).skip(1).filter_map(profile).collect())
}

fn profile(line: &str) -> Option<Profile> {
    let cells: Vec<&str> = line.split(',').collect();
    let number = |k: usize| Rational::parse_decimal(cells.get(k)?);
    let millimetres = |k: usize| number(k).map(|v| v.to_f64() / 1000.0);
    let centimetres = |k: usize, power: i64| Some(&number(k)? * &Rational::from(100).pow(-power)?);
    let kind = match *cells.get(2)? {
        "I" => Kind::Beam,
        "C" => Kind::Channel,
        _ => Kind::Angle,
    };
    let (xx, yy) = (centimetres(11, 4)?, centimetres(12, 4)?);
    // an angle's legs point along +x and +y: its strong axis is at 45 degrees, I_xy = -(I_max - I_x)
    let xy = if kind == Kind::Angle { &xx - &centimetres(13, 4)? } else { Rational::from(0) };
    Some(Profile {
        name: (*cells.first()?).to_owned(),
        standard: (*cells.get(1)?).to_owned(),
        kind,
        sizes: [millimetres(3)?, millimetres(4)?, millimetres(5)?, millimetres(6)?, millimetres(7)?, millimetres(8)?],
        slope: number(9)?.to_f64() / 100.0,
        area: centimetres(10, 2)?,
        xx,
        yy,
        xy,
        z0: if kind == Kind::Beam { millimetres(4)? / 2.0 } else { number(14)?.to_f64() / 100.0 },
    })
}

/// The profile of that name. Case, blanks and № do not matter; Russian letters stand for the Latin ones (`20У`, `20П`, `100х10`).
pub fn find(name: &str) -> Option<&'static Profile> {
    let plain: String = name.chars().filter(|c| !c.is_whitespace() && !"№[]".contains(*c)).flat_map(char::to_lowercase).collect();
    let plain = plain.replace("двутавр", "i").replace("швеллер", "c").replace("уголок", "l");
    let latin = |c: char| match c {
        'у' => 'u',
        'п' => 'p',
        'а' => 'a',
        'х' | '×' | '*' => 'x',
        ',' => '.',
        other => other,
    };
    let plain: String = plain.chars().map(latin).collect();
    let same = |p: &&Profile| {
        let own = p.name.to_lowercase();
        own == plain || p.kind != Kind::Beam && own[1..] == plain
    };
    all().iter().find(same)
}

/// Names of all profiles.
pub fn names() -> impl Iterator<Item = &'static str> {
    all().iter().map(|p| p.name.as_str())
}

#[cfg(test)]
mod tests {
    use super::super::outline::Outline;
    use super::*;

    #[test]
    fn printed_values_follow_from_the_sizes() {
        assert_eq!(all().len(), 91);
        for p in all() {
            let (area, centroid, [xx, yy, xy]) = Outline::profile(p, 64).polygon_moments();
            let near = |printed: f64, drawn: f64, share: f64| {
                assert!((printed - drawn).abs() <= share * printed.abs(), "{}: {printed} against {drawn}", p.name);
            };
            // printed with three or four digits; flanges with slope agree to a per cent
            near(p.area.to_f64(), area, 0.012);
            near(p.xx.to_f64(), xx, 0.012);
            near(p.yy.to_f64(), yy, 0.02);
            if p.kind == Kind::Angle {
                near(p.xy.to_f64(), xy, 0.012);
            }
            let size = p.sizes[1];
            assert!(centroid[0].abs() < 0.004 * size && centroid[1].abs() < 0.004 * size, "{}: {centroid:?}", p.name);
        }
    }

    #[test]
    fn names_in_both_alphabets() {
        for (written, name) in
            [("I20", "I20"), ("i 20", "I20"), ("двутавр 20", "I20"), ("20У", "C20U"), ("швеллер №16аП", "C16aP"), ("100х10", "L100x10")]
        {
            assert_eq!(find(written).map(|p| p.name.as_str()), Some(name), "{written}");
        }
        assert!(find("I21").is_none());
    }
}
