//! Codes of elements between bodies whose axes do not fit.

use words::explain::{Explanation, row};

/// The codes of axes.
pub const AXES: &[Explanation] = &[row(
    "M384",
    ("an element between axes that lie apart", "элемент между разными осями"),
    (
        "A torsion bar, a torsion spring or a rotary damper lies on the common axis of the two bodies that it joins: equal and opposite torques, no forces. Two bodies \
         that turn about fixed parallel axes apart have no such axis; gears, belts, chains or springs between points carry a torque from one to the other, with \
         forces on the bearings. The numbers are those of torques on the relative angle.",
        "Торсион, крутильная пружина или вращательный демпфер лежит на общей оси двух соединяемых тел: моменты равны и противоположны, сил нет. У двух тел, вращающихся \
         вокруг разных неподвижных параллельных осей, общей оси нет; момент между ними передают зубчатые колёса, ремни, цепи или пружины между точками, и при этом нагружаются \
         опоры. Числа отвечают моментам по относительному углу.",
    ),
    "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\norigin = [\"1 m\", 0]\nangle = \"a\"\ninertia = \"1 kg m^2\"\n\
     [bodies.B]\nangle = \"b\"\ninertia = \"1 kg m^2\"\n[torsion_bars.s]\nbetween = [\"A\", \"B\"]\nstiffness = \"5 N m\"\n",
    "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nangle = \"a\"\ninertia = \"1 kg m^2\"\n\
     [bodies.B]\nangle = \"b\"\ninertia = \"1 kg m^2\"\n[torsion_bars.s]\nbetween = [\"A\", \"B\"]\nstiffness = \"5 N m\"\n",
)];
