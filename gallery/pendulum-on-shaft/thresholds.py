#!/usr/bin/env python3
"""Limit masses of the pendulum on a shaft, by bisection over `strutt simulate --set m=...`.

    python3 gallery/pendulum-on-shaft/thresholds.py [path of strutt]

A run of 30 s belongs to the regime of its mean speed over the last 5 s, (phi(30) - phi(25))/5. At a limit that speed jumps, so the
limit is the mass at which it crosses a value between the two regimes; 36 halvings take 2 mg to 3e-14 kg.
"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
STRUTT = sys.argv[1] if len(sys.argv) > 1 else str(HERE.parents[1] / "target/release/strutt")
TOLERANCES = ("1e-12", "1e-14")
# lighter side, heavier side in kg; mean speed in rad/s between the two regimes
LIMITS = [("300 -> 200", 0.0052, 0.0053, 250), ("200 -> 100", 0.0203, 0.0205, 150), ("100 -> hangs", 0.0613, 0.0615, 50)]


def mean_speed(mass, tolerance, *more):
    command = [STRUTT, "simulate", str(HERE / "model.toml"), "--until", "30s", "--at", "25,30", "--outputs", "phi", "--csv", "--tolerance", tolerance]
    out = subprocess.run([*command, "--set", f"m={mass!r}", *more], capture_output=True, text=True, check=True).stdout
    phi = [float(line.split(",")[1]) for line in out.strip().splitlines()[1:]]
    return (phi[1] - phi[0]) / 5


def limit(light, heavy, speed, tolerance):
    for _ in range(36):
        middle = (light + heavy) / 2
        if mean_speed(middle, tolerance) > speed:
            light = middle
        else:
            heavy = middle
    return middle


if __name__ == "__main__":
    for name, light, heavy, speed in LIMITS:
        masses = [limit(light, heavy, speed, tolerance) for tolerance in TOLERANCES]
        print(f"{name:<14}" + "".join(f"  {mass:.13f} kg ({tolerance})" for mass, tolerance in zip(masses, TOLERANCES)), flush=True)
    for mass in (0.004, 0.01, 0.03, 0.07):
        print(f"m = {mass} kg: {mean_speed(mass, '1e-12'):.6f} rad/s")
    print(f"m = 0.07 kg, phi'(0) = 30 rad/s: {mean_speed(0.07, '1e-12', '--set', chr(112) + 'hi' + chr(39) + '=30'):.6f} rad/s")
