#!/usr/bin/env python3
"""Times grainbench beside LAMMPS, LIGGGHTS and YADE on the same beds, one core each.

Alike: balls and their first places (made by grainbench, exported), stiffnesses of normal and tangential
springs, friction, dashpots of small balls, timestep, number of steps, gravity, walls at rest.
Not alike, and why: share/doc/performance.md, Beside other programs.
"""
import argparse
import json
import math
import os
import pathlib
import random
import re
import shlex
import shutil
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
programs = ["grainbench", "LAMMPS", "LIGGGHTS", "YADE"]
packages = {"lmp": "lammps", "liggghts": "liggghts", "yade": "yade"}
commands = {"LAMMPS": "lmp", "LIGGGHTS": "liggghts", "YADE": "yade"}

k = 1e5              # N/m
friction = 0.6
beta = 0.02          # of the critical damping
density = {0.003: 1500.0, 0.006: 2500.0}
speed, flank, period = 0.35, 0.004, 0.1  # m/s, s, s of the shaking: a square wave with flat flanks
radius, low, high = 0.05, -0.1, 0.1      # m, of the cylinder

# steps: what is timed. YADE does fewer in the large bed, where it needs minutes.
cases = {
    "shaken": {"bed": "cylinder", "dt": 1e-5, "warm": 30000, "steps": 30000, "skin": 1.0e-3, "gravity": "pull"},
    "rest": {"bed": "cylinder", "dt": 5e-6, "warm": 2000, "steps": 10000, "skin": 2.0e-4, "gravity": "steady"},
    "rest100k": {"bed": "box", "dt": 5e-6, "warm": 50, "steps": 200, "skin": 2.0e-4, "gravity": "steady"},
}


def mass(r):
    return 4.0 / 3.0 * math.pi * r**3 * density[r]


def run(command, **options):
    done = subprocess.run(command, text=True, errors="replace", capture_output=True, **options)
    if done.returncode != 0:
        sys.exit(f"{shlex.join(map(str, command))} failed:\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
    return done.stdout


def install():
    missing = [package for command, package in packages.items() if not shutil.which(command)]
    if not missing:
        return
    plan = run(["apt-get", "install", "-s", "--no-install-recommends", *missing])
    if "\nRemv " in plan:
        sys.exit(f"installing {missing} would remove packages; do it by hand:\n{plan}")
    subprocess.run([*([] if os.geteuid() == 0 else ["sudo"]), "apt-get", "install", "-y",
                    "--no-install-recommends", *missing], check=True)


def base_scene(bed, box):
    shape = ({"type": "cylinder", "base": [0, 0, low], "radius": radius, "height": high - low}
             if bed == "cylinder" else {"type": "box", "low": [0, 0, 0], "high": box})
    return {
        "format": "grainbench-scene/1",
        "gravity": [0, 0, -9.8],
        "particles": {"species": [{"name": "small", "radius": 0.003, "density": 1500},
                                  {"name": "large", "radius": 0.006, "density": 2500}]},
        "walls": [{"name": "container", "shape": shape, "motion": {"type": "fixed"}}],
        "contact": {"stiffness": {"law": "constant_stiffness", "normal": k, "shear": k},
                    "normal": {"law": "linear_spring"},
                    "friction": {"law": "coulomb_friction", "coefficient": friction},
                    "damping": {"law": "viscous_damping", "normal": beta, "shear": beta, "mode": 0}},
    }


def grainbench(args, work, name, scene):
    path = work / f"{name}.json"
    path.write_text(json.dumps(scene, indent=1))
    folder = work / name
    shutil.rmtree(folder, ignore_errors=True)
    manifest = json.loads(run([*args.wrap, args.program, "run", path, "-o", folder, "--quiet", "--json",
                               "--history-csv", "--threads", "1"]))
    return manifest, folder


def settle(args, work, bed):
    """Balls at rest: a list of (x, y, z, radius), and the far corner of the box."""
    box = [0, 0, 0]
    scene = base_scene(bed, box)
    if bed == "cylinder":
        scene["particles"]["insertion"] = [
            {"type": "random", "species": species, "count": count, "tries": 1000000, "inside": "container",
             "box": {"low": [-0.05, -0.05, floor], "high": [0.05, 0.05, ceiling]}}
            for species, count, floor, ceiling in (("small", 1192, -0.07, -0.01), ("large", 79, -0.1, -0.07))]
        duration = 0.6
    else:
        box, rows = hexagonal(100, 100, 10)
        scene = base_scene(bed, box)
        scene["particles"]["insertion"] = [{"type": "file", "species": "small", "path": "lattice.csv"}]
        (work / "lattice.csv").write_text(
            "x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in rows))
        duration = 0.01
    scene["contact"]["damping"] |= {"normal": 0.3, "shear": 0.3}
    scene["timestep"] = {"type": "fixed", "value": 5e-6}
    scene["stages"] = [{"name": "settle", "duration": duration}]
    _, folder = grainbench(args, work, f"settle-{bed}", scene)
    run([args.program, "export", folder, "--format", "csv", "-o", work / f"settled-{bed}"])
    last = sorted((work / f"settled-{bed}").rglob("particles_*.csv"))[-1]
    lines = last.read_text().splitlines()
    at = {name: n for n, name in enumerate(lines[0].split(","))}
    rows = [line.split(",") for line in lines[1:]]
    return [tuple(float(row[at[c]]) for c in ("x", "y", "z", "radius")) for row in rows], box


def hexagonal(nx, ny, nz):
    """The packing of `grainbench bench`: 0.02 percent loose, with a jitter of less."""
    rng = random.Random(10001)
    half, jitter = 1.0002 * 0.003, 0.00015 * 0.003
    rows = [tuple(c + jitter * rng.uniform(-1, 1) for c in (
        half * (1 + 2 * i + (j + n) % 2), half * (1 + math.sqrt(3) * (j + (n % 2) / 3)),
        half * (1 + math.sqrt(8 / 3) * n))) for n in range(nz) for j in range(ny) for i in range(nx)]
    return [half * (2 * nx + 1), half * (2 + math.sqrt(3) * (ny - 1 + 1 / 3)),
            half * (4 + math.sqrt(8 / 3) * nz)], rows


def write_balls(work, bed, balls, box):
    """The same balls in the formats of all."""
    size = lambda r: min(density, key=lambda known: abs(known - r))
    with open(work / f"{bed}.csv", "w") as out:
        out.write("x,y,z,species\n")
        out.writelines(f"{x!r},{y!r},{z!r},{'small' if size(r) < 0.004 else 'large'}\n" for x, y, z, r in balls)
    with open(work / f"{bed}.txt", "w") as out:
        out.writelines(f"{x!r} {y!r} {z!r} {size(r)} {density[size(r)]}\n" for x, y, z, r in balls)
    m = 0.01
    corners = ([(-radius, radius), (-radius, radius), (low, high)] if bed == "cylinder"
               else [(0, box[0]), (0, box[1]), (0, box[2])])
    with open(work / f"{bed}.data", "w") as out:
        out.write(f"balls of grainbench\n\n{len(balls)} atoms\n2 atom types\n\n")
        out.writelines(f"{a - m!r} {b + m!r} {axis}lo {axis}hi\n" for axis, (a, b) in zip("xyz", corners))
        out.write("\nAtoms\n\n")
        out.writelines(f"{n} {1 if size(r) < 0.004 else 2} {2 * size(r)!r} {density[size(r)]!r} {x!r} {y!r} {z!r}\n"
                       for n, (x, y, z, r) in enumerate(balls, 1))
    return corners


def time_grainbench(args, work, name, case, count):
    def seconds(steps):
        scene = base_scene(case["bed"], case["box"])
        scene["particles"]["insertion"] = [{"type": "file", "species": "small", "path": f"{case['bed']}.csv"}]
        scene["timestep"] = {"type": "fixed", "value": case["dt"]}
        scene["stages"] = [{"name": "timed", "duration": (steps - 0.5) * case["dt"]}]
        if case["gravity"] == "pull":
            t = [0.0, 0.0035, 0.0075, 0.0425, 0.0465, 0.0535, 0.0575, 0.0925, 0.0965, 0.1]
            v = [0, 0, speed, speed, 0, 0, -speed, -speed, 0, 0]
            scene["walls"][0]["motion"] = {"type": "table", "direction": [0, 0, 1], "times": t, "speeds": v,
                                           "repeat": True}
        manifest, folder = grainbench(args, work, name, scene)
        one = manifest["realisations"][0]
        assert one["cycles"] == steps, (one["cycles"], steps)
        lines = (folder / "history.csv").read_text().splitlines()
        last = dict(zip(lines[0].split(","), lines[-1].split(",")))
        return one["cpu_seconds"], float(last["kinetic_energy"]), float(last["contacts_active"])
    before = seconds(case["warm"])[0]
    after, energy, touching = seconds(case["warm"] + case["steps"])
    return after - before, energy, touching


def time_peer(args, work, program, case):
    gamma = lambda m_eff: 2 * beta * math.sqrt(k / m_eff)
    m_pair, m_wall = 0.5 * mass(0.003), mass(0.003)
    (x0, x1), (y0, y1), (z0, z1) = case["corners"]
    values = {"data": work / f"{case['bed']}.data", "shape": case["bed"], "round": int(case["bed"] == "cylinder"), "skin": case["skin"], "k": k,
              "gamma_pair": gamma(m_pair), "gamma_wall": gamma(m_wall), "friction": friction,
              "gravity": case["gravity"], "push": speed / flank, "period": period, "dt": case["dt"],
              "warm": case["warm"], "steps": case["steps"],
              "x0": x0, "x1": x1, "y0": y0, "y1": y1, "z0": z0, "z1": z1}
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    if program == "YADE":
        values |= {"balls": str(work / f"{case['bed']}.txt"), "data": str(values["data"]),
                   "c": gamma(m_pair) * m_pair}
        text = run([*args.wrap, "yade", "-j1", "-n", "-x", here / "bed.yade.py"],
                   env={**environment, "PEER_CASE": json.dumps(values)}, cwd=work)
        seconds = float(re.search(r"LOOP (\S+)", text).group(1))
    else:
        deck = here / ("bed.lammps" if program == "LAMMPS" else "bed.liggghts")
        pairs = [part for key, value in values.items() for part in ("-var", key, str(value))]
        log = ["-log", "none"] if program == "LAMMPS" else ["-log", str(work / "log.liggghts")]
        text = run([*args.wrap, commands[program], "-in", deck, *log, *pairs], env=environment, cwd=work)
        seconds = float(re.findall(r"Loop time of (\S+) on", text)[-1])
    energy, touching = re.findall(r"^RESULT energy (\S+) touching (\S+)", text, re.M)[-1]
    return seconds, float(energy), float(touching)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/cli/grainbench", type=pathlib.Path)
    parser.add_argument("--work", default="out/peers", type=pathlib.Path, help="folder for decks and results")
    parser.add_argument("--repeat", default=3, type=int, help="rounds, in each of which all programs run once")
    parser.add_argument("--case", action="append", choices=cases, help="only this; may be repeated")
    parser.add_argument("--only", action="append", choices=programs, help="only this; may be repeated")
    parser.add_argument("--wrap", default="", help="in front of each timed command, as 'taskset -c 1'")
    parser.add_argument("--skin", type=float, help="[m] of the peers, instead of that of the case")
    args = parser.parse_args()
    args.wrap = shlex.split(args.wrap)
    args.program = args.program.resolve()
    work = args.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    install()
    chosen = args.only or programs
    results = {}
    beds = {}
    for name in args.case or cases:
        case = dict(cases[name], period=period)
        bed = case["bed"]
        if bed not in beds:
            balls, box = settle(args, work, bed)
            beds[bed] = len(balls), box, write_balls(work, bed, balls, box)
        count, case["box"], case["corners"] = beds[bed]
        case["skin"] = args.skin or case["skin"]
        rows = {program: [] for program in chosen}
        for turn in range(args.repeat):
            for program in chosen if turn % 2 == 0 else reversed(chosen):
                print(f"{name}, round {turn + 1}: {program}", file=sys.stderr)
                rows[program].append(time_grainbench(args, work, name, case, count) if program == "grainbench"
                                     else time_peer(args, work, program, case))
        results[name] = {"balls": count, "steps": case["steps"], "skin": case["skin"], "programs": {
            program: {"seconds": [row[0] for row in row_list],
                      "step_time": min(row[0] for row in row_list) / (count * case["steps"]),
                      "kinetic_energy": row_list[-1][1], "touching": row_list[-1][2] / count}
            for program, row_list in rows.items()}}
    (work / "results.json").write_text(json.dumps(results, indent=1))
    print("| case | balls | program | ns per ball and step | times grainbench | touching per ball | kinetic energy, J |")
    print("|---|---|---|---|---|---|---|")
    for name, result in results.items():
        ours = result["programs"].get("grainbench", {}).get("step_time")
        for program, row in result["programs"].items():
            ratio = f"{row['step_time'] / ours:.1f}" if ours else "-"
            print(f"| {name} | {result['balls']} | {program} | {1e9 * row['step_time']:.1f} | {ratio} | "
                  f"{row['touching']:.2f} | {row['kinetic_energy']:.2e} |")


if __name__ == "__main__":
    main()
