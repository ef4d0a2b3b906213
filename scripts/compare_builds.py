#!/usr/bin/env python3
"""Bakes meshes with two builds of shbake in turns and prints, for each kind of bake, the ratios B / A of CPU time, peak
memory and error: medians over the rounds, with the range of the ratios of CPU time.

Usage: compare_builds.py PROGRAM_A PROGRAM_B MESH..."""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROUNDS = 5
RAYS = "256"
KINDS = {"shadowed": ["--transfer", "shadowed"], "interreflected": []}
REFERENCE = ["--rays", "16384", "--seed", "24301"]


def run(*command):
    """Runs a command to its end; returns what it printed, its CPU seconds and its peak memory in bytes."""
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen(list(map(str, command)), stdout=out)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            sys.exit(f"compare_builds: {' '.join(map(str, command))} ended with {process.returncode}")
        out.seek(0)
        return out.read().decode(), usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def measure(programs, mesh, options, folder):
    """CPU seconds and peak memory of each round, and errors against a reference that B bakes: one list a program."""
    reference = folder / "reference.ply"
    run(programs[1], "bake", mesh, "-q", "-o", reference, *options, *REFERENCE)
    cpu, memory, error = ([], []), ([], []), ([], [])
    for seed in range(1, ROUNDS + 1):
        for i, program in enumerate(programs):
            baked = folder / f"{i}.ply"
            _, seconds, peak = run(program, "bake", mesh, "-q", "-o", baked, "--threads", "1", "--rays", RAYS, "--seed",
                                   seed, *options)
            cpu[i].append(seconds)
            memory[i].append(peak)
            difference = json.loads(run(programs[1], "compare", baked, reference, "--json", "-")[0])
            error[i].append(difference["difference"]["rms"])
    return cpu, memory, error


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    for file in sys.argv[1:]:
        if not pathlib.Path(file).is_file():
            sys.exit(f"compare_builds: there is no file {file}")
    programs, meshes = sys.argv[1:3], sys.argv[3:]
    print(f"{'mesh':20} {'transfer':15} {'CPU of A':>10} {'B / A':>7} {'range':>13} {'memory B / A':>13} "
          f"{'error of A':>11} {'B / A':>7}")
    with tempfile.TemporaryDirectory(prefix="shbake-compare-") as folder:
        for mesh in meshes:
            for kind, options in KINDS.items():
                cpu, memory, error = measure(programs, mesh, options, pathlib.Path(folder))
                ratios = [b / a for a, b in zip(*cpu)]
                smaller = statistics.median(memory[1]) / statistics.median(memory[0])
                errors = [statistics.median(e) for e in error]
                change = f"{errors[1] / errors[0]:7.3f}" if errors[0] > 0 else f"{'-':>7}"
                print(f"{pathlib.Path(mesh).stem:20} {kind:15} {statistics.median(cpu[0]):8.3f} s "
                      f"{statistics.median(ratios):7.3f} {min(ratios):6.3f}-{max(ratios):5.3f} {smaller:13.3f} "
                      f"{100 * errors[0]:9.3f} % {change}", flush=True)


if __name__ == "__main__":
    main()
