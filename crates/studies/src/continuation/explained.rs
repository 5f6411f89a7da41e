//! The codes of the study.

use words::explain::{Explanation, plain};

pub(super) const EXPLANATIONS: &[Explanation] = &[
    plain(
        "S150",
        ("no period to follow", "нет периода, который можно проследить"),
        (
            "The study `continue` follows motions that repeat after whole periods of their loads. When the frequency of a load is the parameter, the period changes with it: give it as a \
             formula of the parameter, period = \"2*pi/w\", in the study itself or in a study `periodic` of the file. At each point the laws of the machine are held against that period.",
            "Расчёт `continue` прослеживает движения, которые повторяются через целое число периодов нагрузок. Если параметр — частота нагрузки, период меняется вместе с ней: задайте его \
             формулой от параметра, period = \"2*pi/w\", в самом расчёте или в расчёте `periodic` того же файла. В каждой точке проверяется, что законы машины действительно повторяются через этот период.",
        ),
    ),
    plain(
        "S169",
        ("a switch where the period begins", "переключение в начале периода"),
        (
            "A regime is followed by its state at the beginning of the period. Where an impact, the end of a sticking or another switch comes to lie just there, what is free at the start is not what is free a period \
             later: a rate that sticking fixes at t = 0 is no unknown, although the body slides at t = T. The regime itself goes on; begin its period at another instant (t + t0 for t in the formulas of time) to follow it further.",
            "Режим прослеживается по его состоянию в начале периода. Если удар, конец залипания или другое переключение попадает именно туда, то в начале свободно не то, что период спустя: скорость, заданная \
             залипанием при t = 0, не является неизвестной, хотя при t = T тело скользит. Сам режим продолжается; чтобы проследить его дальше, начните период в другой момент (t + t0 вместо t в формулах времени).",
        ),
    ),
    plain(
        "S151",
        ("a motion that runs on", "движение, которое не возвращается"),
        (
            "A free motion whose coordinates run on (a wheel that rolls, a rotor that turns at a speed of its own) repeats only in a frame that moves along. `periodic` finds it; `continue` \
             follows motions that come back, whole turns of angles apart.",
            "Свободное движение, координаты которого растут (катящееся колесо, ротор, вращающийся с собственной скоростью), повторяется лишь в подвижной системе отсчёта. `periodic` его находит; \
             `continue` прослеживает движения, которые возвращаются с точностью до целых оборотов углов.",
        ),
    ),
    plain(
        "S152",
        ("no direction at the start", "нет направления в начальной точке"),
        (
            "Where a branch begins its direction follows from the derivatives by the start and the parameter. In a machine without damping free oscillations form families at each value of the parameter, and nothing \
             singles one out; at a fold or a branch point the direction is not that of the parameter. Begin at another value, or give the machine damping.",
            "Направление ветви в начальной точке следует из производных по началу и параметру. В машине без сопротивления свободные колебания образуют семейство при каждом значении параметра, и ни одно \
             не выделено; в точке поворота или ветвления направление иное. Начните с другого значения или введите сопротивление.",
        ),
    ),
    plain(
        "S153",
        ("no place of rest to begin with", "не с чего начать: равновесие не найдено"),
        (
            "The study `continue` looks for the first place of rest from the start that the file gives to the coordinates, with the parameter at the value of the file where that lies in the range, otherwise at \
             its least value. Give a start near a place that `strutt equilibrium` names.",
            "Расчёт `continue` ищет первое положение равновесия от начальных значений координат из файла при значении параметра из файла, если оно лежит в промежутке, иначе при \
             наименьшем. Задайте начальные значения вблизи положения, которое называет `strutt equilibrium`.",
        ),
    ),
    plain(
        "S154",
        ("a driven machine does not rest", "машина с переменными нагрузками не бывает в равновесии"),
        (
            "Time occurs in the equations, so that nothing rests for long. The study `continue` follows periodic motions where it is told their period: period = \"2*pi/w\".",
            "Время входит в уравнения, поэтому положений равновесия нет. Расчёт `continue` прослеживает периодические движения, если указан их период: period = \"2*pi/w\".",
        ),
    ),
    plain(
        "S155",
        ("rest under contacts or dry friction", "равновесие при контактах или сухом трении"),
        (
            "Dry friction lets a machine rest in whole ranges of places, and a contact may close or open along the parameter: there is no single branch. The study `equilibrium` names the ranges, `strutt sweep` repeats it over \
             the parameter and follows contacts. Periodic motions with contacts and friction are followed by `continue` with a `period` or `section`.",
            "При сухом трении машина может покоиться в целых областях положений, а контакт вдоль параметра может замкнуться или разомкнуться: единственной ветви нет. Области называет расчёт `equilibrium`, \
             `strutt sweep` повторяет его по параметру и учитывает контакты. Периодические движения с контактами и трением `continue` прослеживает, если задать `period` или `section`.",
        ),
    ),
    plain(
        "S156",
        ("a fold or period doubling that cannot be followed", "складка или удвоение периода не прослеживается"),
        (
            "Along a curve of folds one multiplier stays at 1 (a root at 0), along one of period doublings at −1. Where a second multiplier comes to the same place, as at the onset of a pair of them, the curve has no single \
             direction by these equations and ends there.",
            "Вдоль кривой складок один мультипликатор остаётся равным 1 (корень равен 0), вдоль кривой удвоений периода — равным −1. Если туда же приходит второй мультипликатор, эти уравнения не определяют \
             направления кривой, и она там обрывается.",
        ),
    ),
    plain(
        "S157",
        ("the second parameter is not where the branches are", "второй параметр не там, где построены ветви"),
        (
            "With `second` the study `continue` follows the folds and period doublings of its branches over another parameter. The branches have the value of that parameter that the file gives, so the range of `second` \
             has to contain it.",
            "С ключом `second` расчёт `continue` прослеживает складки и удвоения периода своих ветвей вдоль другого параметра. Ветви построены при том его значении, которое дано в файле, поэтому промежуток `second` \
             должен это значение содержать.",
        ),
    ),
    plain(
        "S158",
        ("no backbone curve without a kept energy", "скелетная кривая требует сохранения энергии"),
        (
            "A backbone curve is the family of free oscillations of a machine without losses: to each energy its motion. Damping, drives, dry friction and follower forces take that family away. Set them to zero for the study, \
             `--set b=0 --set F=0`; what the damped and driven machine does is told by `of = \"periodic\"`.",
            "Скелетная кривая — семейство свободных колебаний машины без потерь: каждой энергии отвечает своё движение. При сопротивлениях, приводах, сухом трении и следящих силах такого семейства нет. Задайте их для этого расчёта нулевыми, \
             `--set b=0 --set F=0`; поведение машины с сопротивлением и нагрузкой описывает `of = \"periodic\"`.",
        ),
    ),
    plain(
        "S159",
        ("a backbone curve has no beginning", "скелетной кривой не с чего начаться"),
        (
            "A backbone curve begins with small oscillations of a natural mode about the place of rest near the start of the file, at their frequency, which has to lie in the range. Where two modes have one frequency, or one is a \
             multiple of the other, small oscillations mix them and none begins alone.",
            "Скелетная кривая начинается с малых колебаний по собственной форме около положения равновесия, ближайшего к начальному положению из файла; их частота должна лежать в заданном промежутке. Если две частоты совпадают или \
             кратны друг другу, малые колебания смешивают такие формы и отдельной формы нет.",
        ),
    ),
    plain(
        "S166",
        ("no periodic motion by collocation", "коллокация не находит периодического движения"),
        (
            "Where multipliers are so large that a whole period keeps no digits of its start, `continue` finds its points by collocation: the motion is put together of polynomials on a mesh. That is for smooth motions; where a \
             contact, a dry friction or a change of formula switches on the way, or the polynomials do not settle, the branch ends there.",
            "Если мультипликаторы так велики, что за период теряются все знаки начальных условий, `continue` находит точки коллокацией: движение составляется из многочленов на сетке. Это возможно для гладких движений; если на пути \
             переключается контакт, сухое трение или формула либо многочлены не сходятся, ветвь там обрывается.",
        ),
    ),
    plain(
        "S170",
        ("a backbone curve needs the frequency of a load", "скелетная кривая строится по частоте нагрузки"),
        (
            "With `backbone` the study `continue` lays the free oscillations of the machine without losses and loads over its frequency response. Both have one axis only where the parameter is the frequency of the load, in \
             rad/s or Hz: period = \"2*pi/w\" with parameter = \"w\".",
            "С ключом `backbone` расчёт `continue` показывает поверх амплитудно-частотной характеристики свободные колебания машины без потерь и нагрузок. Общая ось у них есть лишь тогда, когда параметр — частота нагрузки в рад/с \
             или Гц: period = \"2*pi/w\" при parameter = \"w\".",
        ),
    ),
];
