//! What is to be said of a response beside its numbers.

use crate::small::asked::Response as Study;
use analysis::Quantity;
use analysis::studies::tracks::Tracks;
use symbolic::Equations;
use symbolic::equations::Role;
use words::Text;

/// Share that rounding of the stiffnesses may change without a remark.
const UNDOUBTED: f64 = 1e-6;

/// Rows that have no place of rest.
pub(super) fn cut(asked: usize, omegas: &[f64]) -> Option<Text> {
    let ends = [omegas[0], omegas[omegas.len() - 1]];
    let list = |language| ends.map(|w| report::number::short(w, 6, language));
    let ([a, b], [c, d]) = (list(words::Language::En), list(words::Language::Ru));
    (omegas.len() < asked).then(|| {
        Text::new(
            format!("rows from ω = {a} to {b} rad/s only, {} of {asked}: beyond them the place of rest that the machine has here is lost", omegas.len()),
            format!(
                "приведены только строки от ω = {c} до {d} рад/с, {} из {asked}: дальше положения равновесия, занимаемого машиной здесь, нет",
                omegas.len()
            ),
        )
    })
}

pub(super) fn unstable(tracks: &Tracks) -> Text {
    let list = |language| {
        let number = |x| report::number::short(x, 6, language);
        tracks.unstable.iter().map(|[a, b]| format!("{} … {}", number(*a), number(*b))).collect::<Vec<_>>().join("; ")
    };
    let name = &tracks.parameter;
    Text::new(
        format!(
            "unstable for {name} = {} rad/s: a free motion grows there, and the amplitudes of the table are never reached",
            list(words::Language::En)
        ),
        format!(
            "неустойчиво при {name} = {} рад/с: свободное движение там нарастает, и амплитуды таблицы не устанавливаются",
            list(words::Language::Ru)
        ),
    )
}

/// An output that is not linear in the motion.
pub(super) fn not_straight(name: &str, share: f64) -> Text {
    let percent = |language| report::number::short(100.0 * share, 3, language);
    let far = match share.is_finite() {
        true => Text::new(
            format!("leaves its straight line by {} % within the amplitudes found", percent(words::Language::En)),
            format!("отклоняется в пределах найденных амплитуд от линейной зависимости на {} %", percent(words::Language::Ru)),
        ),
        false => Text::new("has no linear part there", "не имеет там линейной части"),
    };
    Text::new(
        format!(
            "`{name}` is not linear in the motion and {}: its amplitude, phase and coefficient are those of the line, mean, greatest and least value over a period those of the formula \
             along the small motion; use `periodic` or `simulate` where that is not enough",
            far.en
        ),
        format!(
            "величина `{name}` нелинейна относительно движения и {}: амплитуда, фаза и коэффициент относятся к линейной части, а среднее, наибольшее и наименьшее за период – к самой \
             формуле вдоль малого движения; если этого мало, примените `periodic` или `simulate`",
            far.ru
        ),
    )
}

/// An output with a part that follows time by itself, under a load alone.
pub(super) fn by_itself(name: &str) -> Text {
    Text::new(
        format!(
            "`{name}` also depends on time by itself; under the one load its amplitude is that of what the load moves, without that part"
        ),
        format!(
            "величина `{name}` зависит от времени и непосредственно; под одной нагрузкой её амплитуда – это то, что вызывает сама нагрузка, без этой части"
        ),
    )
}

/// An output that is not linear in reactions.
pub(super) fn of_reactions(name: &str) -> Text {
    Text::new(
        format!(
            "`{name}` is not linear in reactions: its amplitude is that of its line at rest and holds for small motions only, and its mean, greatest and least value over a period are left out; `simulate` and `periodic` have them"
        ),
        format!(
            "величина `{name}` нелинейно зависит от реакций: её амплитуда относится к линейному приближению около положения равновесия и верна лишь при малых движениях, а среднее, наибольшее и наименьшее за период значения не даны; их дают `simulate` и `periodic`"
        ),
    )
}

/// An output with a part that time prescribes, under the loads of the equations.
pub(super) fn prescribed(name: &str) -> Text {
    Text::new(
        format!(
            "`{name}` contains a function of time itself, the motion of a base say: what of it is static would depend on the choice of coordinates, so it has no dynamic coefficient; its amplitude over that of the base is the transmissibility"
        ),
        format!(
            "величина `{name}` содержит саму функцию времени, например движение основания: её статическая часть зависела бы от выбора координат, поэтому коэффициента динамичности нет; отношение её амплитуды к амплитуде основания – коэффициент передачи"
        ),
    )
}

/// An output with a part at a rate that no load has.
pub(super) fn foreign(name: &str, rate: f64) -> Text {
    let [en, ru] = [words::Language::En, words::Language::Ru].map(|language| report::number::short(rate, 6, language));
    Text::new(
        format!(
            "`{name}` also oscillates by itself at {en} rad/s, which is none of the loads' frequencies: its amplitudes, greatest and least values are without that part"
        ),
        format!(
            "величина `{name}` колеблется и непосредственно, с частотой {ru} рад/с, которой у нагрузок нет: её амплитуды, наибольшее и наименьшее значения даны без этой части"
        ),
    )
}

/// Where the frequency of the load is a multiple of the parameter that sets it.
pub(super) fn axis(parameter: &Quantity, multiple: Option<f64>) -> Option<Text> {
    // a multiple that is 1 but for rounding is the parameter itself
    let multiple = multiple.filter(|k| parameter.unit == "rad/s" && (k - 1.0).abs() > 1e-12)?;
    let [en, ru] = [words::Language::En, words::Language::Ru].map(|language| report::number::short(multiple, 6, language));
    let name = &parameter.name;
    Some(Text::new(
        format!("ω is the frequency of the load, {en} times {name}: the range, the rows and the resonances are given in it"),
        format!("ω – частота нагрузки, равная {ru}·{name}: в ней заданы диапазон, строки и резонансы"),
    ))
}

/// Outputs of the file that nobody asked for.
pub(super) fn not_shown(study: &Study, equations: &Equations) -> Option<Text> {
    let own: Vec<&str> = equations.outputs.iter().filter(|o| matches!(o.role, Role::Named)).map(|o| o.name.as_str()).collect();
    (study.outputs.is_empty() && !own.is_empty()).then(|| {
        let list = own.join(", ");
        Text::new(
            format!("not shown: the outputs {list} of the file; name those that are wanted with outputs"),
            format!("не показаны величины файла {list}; нужные укажите ключом outputs"),
        )
    })
}

pub(super) fn bent_by_rates() -> Text {
    Text::new(
        "the equations are not linear: forces of higher degree in the rates are left out, so the amplitudes hold for small motions only; `periodic` has them",
        "уравнения нелинейны: силы высших степеней скоростей отброшены, и амплитуды верны лишь для малых движений; `periodic` их учитывает",
    )
}

pub(super) fn left_out(rates: &[f64]) -> Option<Text> {
    if rates.is_empty() {
        return None;
    }
    let list = |decimal: &str| {
        let one = |w: &f64| report::number::short(*w, 6, words::Language::En).replace('.', decimal);
        rates.iter().map(one).collect::<Vec<_>>().join("; ")
    };
    Some(Text::new(
        format!(
            "left out: loads whose frequency does not follow the one along the axis ({} rad/s); name them with load or over",
            list(".")
        ),
        format!("не учтены нагрузки, частота которых не меняется вдоль оси ({} рад/с); задайте их ключом load или over", list(",")),
    ))
}

/// What rounding may have taken.
pub(super) fn doubtful(doubt: f64) -> Option<Text> {
    let share = |language| report::number::short(100.0 * doubt, 2, language);
    (doubt > UNDOUBTED).then(|| {
        Text::new(
            format!(
                "stiffnesses lie so far apart that the rounding of their sums may change the amplitudes by {} %",
                share(words::Language::En)
            ),
            format!("жёсткости настолько различны, что округление их сумм может изменить амплитуды на {} %", share(words::Language::Ru)),
        )
    })
}

pub(super) fn reference(function: &str, angle: &str) -> Text {
    let wave = format!("{function} {angle}");
    Text::new(
        format!(
            "a motion is amplitude times {wave} shifted by the phase; phases are counted from {wave}, whatever the phase of the load, and negative when the motion lags behind it"
        ),
        format!(
            "движение – амплитуда, умноженная на {wave} со сдвигом фазы; фазы отсчитываются от {wave} независимо от начальной фазы нагрузки, при отставании от {wave} они отрицательны"
        ),
    )
}
