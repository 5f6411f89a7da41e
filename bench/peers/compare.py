"""Runs strutt and a peer in turn (pairs), takes medians, prints ratios and versions. See run.sh."""
import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))


def peer(job, value, limit):
    began = time.perf_counter()
    try:
        out = subprocess.run([sys.executable, os.path.join(HERE, "peers.py"), job, str(value)], capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    if out.returncode:
        print(out.stderr, file=sys.stderr)
        return None
    return json.loads(out.stdout) | {"process": time.perf_counter() - began}


def strutt(arguments):
    began = time.perf_counter()
    out = subprocess.run(arguments, capture_output=True, text=True)
    took = time.perf_counter() - began
    if out.returncode:
        sys.exit(f"{' '.join(arguments)} failed:\n{out.stderr}")
    return took, out.stdout


def frame(o):
    """20 lowest modes of large plane frames: the solution alone, matrices given, on one core (see run.sh)."""
    print("\nplane frame of n x n bays, Euler-Bernoulli rods, consistent mass, 20 lowest modes; scipy: eigsh(sigma=0), one core, matrices given")
    print(f"{'n':>5}{'unknowns':>10}{'strutt s':>10}{'scipy s':>10}{'strutt / scipy':>16}{'least':>8}{'most':>8}{'strutt MB':>11}{'scipy MB':>10}{'difference':>12}")
    for bays in (60, 120, 180):
        own, other = [], []
        for _ in range(o.pairs):
            own.append(json.loads(strutt([o.frame, str(bays)])[1]))
            other.append(peer("frame_scipy", bays, o.limit))
            if other[-1] is None:
                print(f"{bays:>5}{'over the limit':>40}")
                return
        ratios = sorted(a["solution"] / b["solution"] for a, b in zip(own, other))
        s, w = statistics.median(a["solution"] for a in own), statistics.median(b["solution"] for b in other)
        difference = max(abs(x / y - 1) for x, y in zip(own[0]["values"], other[0]["values"]))
        print(f"{bays:>5}{own[0]['size']:>10}{s:10.3f}{w:10.3f}{statistics.median(ratios):16.2f}{ratios[0]:8.2f}{ratios[-1]:8.2f}"
              f"{own[0]['memory_mb']:11.0f}{other[0]['memory_mb']:10.0f}{difference:12.1e}", flush=True)


def sweep(o):
    """Many motions of card P3: the whole process of `sweep` on one thread, with all checks of a motion, against heyoka's loop, four motions at a time, which has none."""
    rows = 200
    model = os.path.join(o.root, "gallery/pendulum-on-shaft/model.toml")
    command = [o.strutt, "sweep", model, "--over", f"m=linspace(2 g, 60 g, {rows})", "--until", "30s", "--tolerance", "1e-9",
               "--observe", "mean(phi', 20 s, 30 s)", "--threads", "1", "--csv"]
    own, other, difference = [], [], 0.0
    for _ in range(o.pairs):
        took, csv = strutt(command)
        found = peer("sweep_heyoka", rows, o.limit)
        if found is None:
            return print("\nsweep of card P3: over the limit")
        own.append(1e3 * took / rows)
        other.append(1e3 * found["run"] / rows)
        means = [float(line.split(",")[1]) for line in csv.strip().splitlines()[1:]]
        difference = max(abs(a / b - 1) for a, b in zip(means, found["means"]))
    ratios = sorted(a / b for a, b in zip(own, other))
    print(f"\nsweep of card P3, {rows} rows of 30 s, tolerance 1e-9, ms a row: strutt {statistics.median(own):.2f} (all checks), heyoka's batch of 4 {statistics.median(other):.2f} (none); "
          f"strutt / heyoka {statistics.median(ratios):.1f}, least {ratios[0]:.1f}, most {ratios[-1]:.1f}; largest difference of the means {difference:.1e}", flush=True)


def last_value(csv, name):
    rows = [line.split(",") for line in csv.strip().splitlines()]
    column = next(i for i, cell in enumerate(rows[0]) if cell.split(" ")[0] == name)
    return float(rows[-1][column])


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--strutt", required=True)
    options.add_argument("--root", required=True)
    options.add_argument("--frame", required=True, help="the example `frame` of strutt-analysis")
    options.add_argument("--only", choices=["frame", "sweep"], help="this part alone")
    options.add_argument("--pairs", type=int, default=5)
    options.add_argument("--max-n", type=int, default=10, help="largest chain for the peers")
    options.add_argument("--limit", type=float, default=120, help="seconds for one peer's job")
    o = options.parse_args()
    median = statistics.median
    import heyoka, numpy, scipy, sympy
    version = subprocess.run([o.strutt, "--version"], capture_output=True, text=True).stdout.strip()
    print(f"{version}; heyoka {heyoka.__version__}, numpy {numpy.__version__}, scipy {scipy.__version__}, sympy {sympy.__version__}, "
          f"python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores; medians of {o.pairs} pairs\n")

    if o.only == "frame":
        return frame(o)
    if o.only == "sweep":
        return sweep(o)
    model = os.path.join(o.root, "gallery/pendulum-on-shaft/model.toml")
    command = [o.strutt, "simulate", model, "--until", "30s", "--tolerance", "1e-9", "--at", "30", "--outputs", "phi", "--csv"]
    print("pendulum on a shaft, 30 s, tolerance 1e-9 (strutt: whole process, file to CSV; a peer's set-up and run leave out the start of Python and the import)")
    print(f"{'peer':<10}{'strutt s':>12}{'process s':>12}{'set-up s':>12}{'run s':>12}{'ratio process':>15}{'ratio set-up+run':>18}{'difference of phi(30)':>24}")
    for name, job, pairs in (("heyoka", "shaft_heyoka", o.pairs), ("scipy", "shaft_scipy", min(o.pairs, 3))):
        own, whole, setup, run, difference = [], [], [], [], 0.0
        for _ in range(pairs):
            took, csv = strutt(command)
            other = peer(job, 1e-9, o.limit)
            if other is None:
                break
            own.append(took)
            whole.append(other["process"])
            setup.append(other.get("set-up", 0.0))
            run.append(other["run"])
            difference = last_value(csv, "phi") - other["phi(30)"]
        if not run:
            print(f"{name:<10}{'over the limit':>40}")
            continue
        s, w, u, r = median(own), median(whole), median(setup), median(run)
        print(f"{name:<10}{s:12.4f}{w:12.4f}{u:12.4f}{r:12.4f}{w / s:15.1f}{(u + r) / s:18.2f}{difference:24.2e}", flush=True)

    print("\nchain of n pendulums, separate m_i and l_i, derivation (strutt: whole process of `check`, which derives; peers: derivation only, no import)")
    print(f"{'n':>4}{'strutt s':>12}{'sympy s':>12}{'ratio':>10}{'heyoka s':>12}{'ratio':>10}")
    sys.path.insert(0, os.path.join(o.root, "gallery/n-pendulum"))
    from generate import model as chain
    beyond = set()
    for n in range(2, 11):
        with tempfile.NamedTemporaryFile("w", suffix=".toml", delete=False) as file:
            file.write(chain(n))
        own, cells = [], {}
        pairs = o.pairs if n <= 4 else 1
        for _ in range(pairs):
            own.append(strutt([o.strutt, "check", file.name])[0])
            for job in ("chain_sympy", "chain_heyoka"):
                if job in beyond or n > o.max_n:
                    continue
                other = peer(job, n, o.limit)
                if other is None:
                    beyond.add(job)
                else:
                    cells.setdefault(job, []).append(other["derive"])
        os.unlink(file.name)
        s = median(own)
        line = f"{n:>4}{s:12.4f}"
        for job in ("chain_sympy", "chain_heyoka"):
            line += f"{median(cells[job]):12.4f}{median(cells[job]) / s:10.1f}" if job in cells else f"{'-':>12}{'-':>10}"
        print(line, flush=True)

    print("\nderivation and lowering alone, without the process:", flush=True)
    subprocess.run(["cargo", "bench", "--quiet", "--manifest-path", os.path.join(o.root, "Cargo.toml"), "-p", "strutt", "--bench", "derivation"], check=False)
    frame(o)
    sweep(o)


if __name__ == "__main__":
    main()
