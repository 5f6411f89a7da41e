#!/usr/bin/env python3
"""Kills sweeps and maps at random instants, resumes them, and compares what they write with that of a run that nobody disturbed.

    bench/kills/kills.py PROGRAM [runs] [seed]

Each run is killed by SIGKILL or SIGTERM at random instants, up to six times, resumed each time with a random number of threads, and then left to end. All files of its folder must have the bytes of the folder of the
undisturbed run. Needs no package.
"""
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

MODEL = """
[parameters]
l = "1 m"
k = "0.1 1/s"
[coordinates]
phi = { unit = "rad", start = "0.5 rad", rate = "1 rad/s" }
[bodies.bob]
angle = "phi"
mass = "1 kg"
center = ["0", "-l"]
[regimes]
swings = "max(abs(phi), 0 s, 20 s) < 3.2 [rad]"
turns = "max(abs(phi), 0 s, 20 s) >= 3.2 [rad]"
[[study]]
kind = "simulate"
until = "20 s"
"""
WORKS = {
    "sweep": ["--over", "l=linspace(0.5 m, 1.5 m, 300)", "--over", "phi'=1 rad/s, 7 rad/s", "--observe", "mean(phi', 1 s, 20 s),regime,events"],
    "map": ["--x", "phi=-2..2", "--y", "phi'=2 rad/s..9 rad/s", "--regimes", "--cells", "12", "--refine", "2"],
}


def files(folder):
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    chance = random.Random(seed)
    here = pathlib.Path(tempfile.mkdtemp(prefix="strutt-kills-"))
    (here / "m.toml").write_text(MODEL)
    whole, span = {}, {}
    for work, asked in WORKS.items():
        begun = time.monotonic()
        subprocess.run([program, work, "m.toml", *asked, "--out", work, "--quiet"], cwd=here, check=True, stdout=subprocess.DEVNULL)
        span[work], whole[work] = time.monotonic() - begun, files(here / work)
    kills = {signal.SIGKILL: 0, signal.SIGTERM: 0}
    wrong = 0
    for run in range(runs):
        work = chance.choice(list(WORKS))
        out = here / "out"
        shutil.rmtree(out, ignore_errors=True)
        command = [program, work, "m.toml", *WORKS[work], "--out", "out", "--resume", "--quiet"]
        for _ in range(chance.randint(1, 6)):
            threads = str(chance.choice([1, 2, 3]))
            child = subprocess.Popen([*command, "--threads", threads], cwd=here, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(chance.uniform(0.0, 0.7 * span[work]))
            kind = chance.choice(list(kills))
            if child.poll() is None:
                child.send_signal(kind)
                kills[kind] += 1
            child.wait()
        done = subprocess.run(command, cwd=here, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0 or files(out) != whole[work]:
            wrong += 1
            print(f"run {run} of {work}: exit code {done.returncode}, files differ: {files(out).keys() ^ whole[work].keys() or 'bytes'}\n{done.stderr}")
    print(f"{runs} runs, {kills[signal.SIGKILL]} SIGKILL and {kills[signal.SIGTERM]} SIGTERM that met a run, seed {seed}: {wrong} with other bytes")
    shutil.rmtree(here)
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
