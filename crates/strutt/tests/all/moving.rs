//! Moving pictures: places that a page draws are those of the machine, bodies keep their lengths, joints stay closed; pages stay small; films are written.

use crate::common;

use common::{folder, gallery, stderr, strutt};
use report::Scheme;
use report::scheme::moving::{Decoded, RESOLUTION, TURN};
use report::scheme::{LabelText, Moving, P};
use studies::results::Results;
use studies::scheme::played;
use studies::{Source, Watch, pipeline};
use words::Language;

/// Farther than this from what carries it nothing of a picture is, pixels.
const ARM: f64 = 500.0;
/// What the picture may be off: half a step of places, half a step of angles on the longest arm, letters' anchors to a hundredth.
const OFF: f64 = 0.5 * RESOLUTION * 1.42 + 0.5 * TURN * ARM + 0.02;

fn pictures(name: &str) -> Vec<(Moving, Results)> {
    let text = std::fs::read_to_string(gallery(name)).unwrap();
    let calculation = pipeline::run(&Source::new(&gallery(name), &text), &[], &mut Watch::default()).unwrap();
    let machine = &calculation.machine;
    let one = |r: &Results| played(machine, r, Language::En).into_iter().map(|m| (m, r.clone())).collect::<Vec<_>>();
    calculation.results.iter().flat_map(one).collect()
}

/// Where a point that a track carries is by the data of a page.
fn image(data: &Decoded, track: usize, (k, p): (usize, P)) -> P {
    if data.at[track].is_empty() {
        return p;
    }
    let (o, there, (s, c)) = (data.at[track][0], data.at[track][k], data.turn[track][k].sin_cos());
    let [x, y] = [p[0] - o[0], p[1] - o[1]];
    [there[0] + c * x + s * y, there[1] - s * x + c * y]
}

fn labelled(scheme: &Scheme, name: &str) -> (usize, P) {
    let is = |l: &&report::scheme::Label| l.text == LabelText::Symbol(name.to_owned());
    let label = scheme.labels.iter().find(is).unwrap_or_else(|| panic!("no letter {name}"));
    (label.rides.as_ref().unwrap().at, label.at)
}

fn between(times: &[f64], values: &[f64], t: f64) -> f64 {
    let k = times.partition_point(|s| *s <= t).clamp(1, times.len() - 1);
    let share = (t - times[k - 1]) / (times[k] - times[k - 1]);
    values[k - 1] + share * (values[k] - values[k - 1])
}

/// The letter of a point moves as the columns of the study say, up to the scale of the picture, which two places give.
#[test]
fn points_are_where_the_columns_say() {
    for (machine, letter, x, y) in [("four-bar", "M", "x_M", "y_M"), ("five-bar", "B", "x_B", "y_B")] {
        let (moving, results) = pictures(machine).remove(0);
        let data = Decoded::read(&moving.data()).unwrap();
        let axis = &results.data.columns[results.data.axis.unwrap()].values;
        let (track, at) = labelled(&moving.scheme, letter);
        let seen: Vec<P> = (0..data.times.len()).map(|k| image(&data, track, (k, at))).collect();
        for (name, i, sign) in [(x, 0, 1.0), (y, 1, -1.0)] {
            let Some(column) = results.data.column(name) else { continue };
            let truth: Vec<f64> = data.times.iter().map(|t| sign * between(axis, &column.values, *t)).collect();
            let (low, high) = (0..truth.len())
                .fold((0, 0), |(l, h), k| (if truth[k] < truth[l] { k } else { l }, if truth[k] > truth[h] { k } else { h }));
            let scale = (seen[high][i] - seen[low][i]) / (truth[high] - truth[low]);
            assert!(scale > 10.0, "{machine} {name}: {scale}");
            for (k, (place, value)) in seen.iter().zip(&truth).enumerate() {
                let off = (place[i] - seen[low][i] - scale * (value - truth[low])).abs();
                assert!(off < 3.0 * OFF, "{machine} {name}, frame {k}: {off} px");
            }
        }
    }
}

/// The ends of both links of a joint stay together, and the links as long as they are.
#[test]
fn joints_stay_closed_and_links_keep_their_length() {
    for machine in ["four-bar", "slider-crank", "double-pendulum", "five-bar"] {
        let (moving, _) = pictures(machine).remove(0);
        let data = Decoded::read(&moving.data()).unwrap();
        let links: Vec<_> = moving.scheme.items.iter().filter(|i| i.symbol.name == "link" && i.rides.at != 0).collect();
        assert!(!links.is_empty(), "{machine}");
        let mut joints = 0;
        for (i, one) in links.iter().enumerate() {
            for other in &links[i + 1..] {
                let near = |p: P| [other.place.at, other.place.to].into_iter().find(|q| (p[0] - q[0]).hypot(p[1] - q[1]) < 0.5);
                let Some((p, q)) = [one.place.at, one.place.to].into_iter().find_map(|p| near(p).map(|q| (p, q))) else { continue };
                joints += usize::from(one.rides.at != other.rides.at);
                for k in 0..data.times.len() {
                    let (a, b) = (image(&data, one.rides.at, (k, p)), image(&data, other.rides.at, (k, q)));
                    let off = (a[0] - b[0]).hypot(a[1] - b[1]);
                    assert!(off < 2.0 * OFF, "{machine}, frame {k}: {} and {} are {off} px apart", one.path, other.path);
                }
            }
        }
        assert!(joints > 0 || machine == "slider-crank" || machine == "four-bar", "{machine}");
    }
}

/// A ball comes down to its floor and not through it.
#[test]
fn what_a_stop_holds_does_not_pass_it() {
    let (moving, _) = pictures("bouncing-ball").remove(0);
    let data = Decoded::read(&moving.data()).unwrap();
    let find = |symbol: &str| moving.scheme.items.iter().find(|i| i.symbol.name == symbol).unwrap();
    let (block, floor) = (find("block"), find("wall").place.at[1]);
    let bottom = |k: usize| image(&data, block.rides.at, (k, block.place.at))[1] + block.place.other;
    let lowest = (0..data.times.len()).map(bottom).fold(f64::NEG_INFINITY, f64::max);
    assert!((lowest - floor).abs() < 0.5, "{lowest} against {floor}");
}

#[test]
fn every_motion_of_the_gallery_has_a_picture_that_is_small() {
    for name in
        ["atwood", "belt-oscillator", "crank-hoist", "oscillator-linkage", "pendulum-on-shaft", "thread-pendulum", "top", "shaft-line"]
    {
        let found = pictures(name);
        assert!(!found.is_empty(), "{name}");
        for (moving, _) in &found {
            let size = moving.data().to_string().len();
            assert!(size < 1_000_000, "{name}: {size} bytes");
            assert!(moving.pace() > 0.0 && moving.span() / moving.pace() < 181.0, "{name}");
        }
    }
}

#[test]
fn run_writes_a_picture_that_plays_by_itself() {
    let here = folder("animate");
    let told = strutt().args(["run", &gallery("four-bar"), "--animate", "--out"]).arg(&here).env("PATH", "").output().unwrap();
    let told = String::from_utf8_lossy(&told.stderr).into_owned();
    assert!(told.contains("ffmpeg"), "{told}");
    let svg = std::fs::read_to_string(here.join("kinematics-motion.svg")).unwrap();
    assert!(svg.contains("<animateTransform") && svg.contains("repeatCount=\"indefinite\""));
    let page = std::fs::read_to_string(here.join("index.html")).unwrap();
    assert!(page.contains("data-moving=\"0\"") && page.contains("id=\"strutt-moving\""));
}

#[test]
fn the_gallery_has_a_page() {
    let here = folder("gallery-page");
    strutt().args(["gallery", "four-bar", "truss", "--out"]).arg(&here).assert().success();
    let page = std::fs::read_to_string(here.join("index.html")).unwrap();
    assert!(page.contains("four-bar/index.html") && page.contains("truss-still.svg"), "{page}");
    assert!(here.join("four-bar.svg").is_file() && here.join("four-bar/index.html").is_file());
    let told = stderr(strutt().args(["gallery", "four-baar", "--out"]).arg(&here), 2);
    assert!(told.contains("C010"), "{told}");
}
