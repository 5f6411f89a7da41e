#!/usr/bin/env python3
"""Writes the model file of a chain of n pendulums with absolute angles.

    python3 gallery/n-pendulum/generate.py 10 > gallery/n-pendulum/model.toml

The same text is what `strutt new n-pendulum --count N` writes; a file in the gallery keeps n = 10.
"""
import sys


def model(n: int) -> str:
    numbers = range(1, n + 1)
    lines = [
        f'title = {{ en = "Chain of {n} pendulums", ru = "Цепь из {n} маятников" }}',
        "",
        "[description]",
        'en = "Point masses on massless rods, hinged one to the next; every angle is counted from the vertical."',
        'ru = "Точечные массы на невесомых стержнях, последовательно соединённых шарнирами; все углы отсчитываются от вертикали."',
        "",
        "[parameters]",
    ]
    lines += [f'm_{i} = "1 kg"' for i in numbers]
    lines += [f'l_{i} = "0.1 m"' for i in numbers]
    lines += ["", "[coordinates]"]
    lines += [f'phi_{i} = {{ unit = "rad", start = "30 deg", symbol = "φ_{i}" }}' for i in numbers]
    lines += ["", "[points]"]
    lines += [f'A_{i} = {{ on = "link_{i}", at = ["0", "-l_{i}"] }}' for i in numbers]
    for i in numbers:
        lines += ["", f"[bodies.link_{i}]"]
        if i > 1:
            lines += [f'origin = "A_{i - 1}"']
        lines += [f'angle  = "phi_{i}"', f'mass   = "m_{i}"', f'center = ["0", "-l_{i}"]']
    lines += [
        "",
        "[outputs]",
        'E = { value = "kinetic_energy() + potential_energy()", label = { en = "energy", ru = "полная энергия" } }',
        "",
        "[[study]]",
        'kind = "equations"',
        "",
        "[[study]]",
        'kind  = "simulate"',
        'until = "2 s"',
        f'plot  = [["phi_1", "phi_{n}"], "E"]' if n > 1 else 'plot  = ["phi_1", "E"]',
    ]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.stdout.write(model(int(sys.argv[1]) if len(sys.argv) > 1 else 10))
