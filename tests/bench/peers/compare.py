"""Measures fast-winding beside other implementations: same models, same queries, same cores, one run.

    python3 tests/bench/peers/compare.py [--rounds 3] [--threads 1] [--only JOB,...] [--models FILE ...] [--quick]

Installs the peers from PyPI into a throw-away environment under the user's cache, builds our measuring program, runs
each contestant in a process of its own, in turns, and prints tables of medians with ratios (theirs / ours). What is right
is found by the direct sum in f64 (truth.py); jobs and goals are in jobs.py. `--models` adds models of your own: STL,
PLY or OBJ. `--quick` tries everything on few points: its ratios mean little.
"""
import argparse
import os
import pathlib
import platform
import sys
import tempfile
import time

import environment

THIS = pathlib.Path(__file__).resolve().parent
# Seconds a peer may take for one evaluation before only a part of its planes is asked, and ours before it is given up.
PEER_CAP = 6.0
OUR_TIME_LIMIT = 90


def options_of_command_line():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--rounds", type=int, default=3)
    arguments.add_argument("--threads", type=int, default=1)
    arguments.add_argument("--only", default="", help="names of jobs, with commas between")
    arguments.add_argument("--models", nargs="*", default=[], type=pathlib.Path, help="files of your own models")
    arguments.add_argument("--quick", action="store_true")
    options = arguments.parse_args()
    options.models = [path.resolve() for path in options.models]
    options.rounds = 1 if options.quick else options.rounds
    return options


def main():
    options = options_of_command_line()
    environment.enter()
    import jobs
    import models
    from report import table, HEADS, BUILD_HEADS

    own = dict(models.adopt(path) for path in options.models)
    todo = jobs.chosen([name for name in options.only.split(",") if name], own)
    paths = models.make(sorted({name for job in todo if not job.own for name in job.models})) | own
    program = environment.measuring_program()
    print(f"\n{options.threads} thread(s), medians of {options.rounds} round(s), {platform.processor() or platform.machine()}")
    print(load())
    verdicts = {}
    with tempfile.TemporaryDirectory(dir=models.MODELS) as name:
        bench = Bench(options, program, pathlib.Path(name))
        for job in todo:
            rows = []
            for model in job.models:
                started = time.perf_counter()
                for cells, best in bench.run(job, model, paths[model]):
                    rows.append(cells)
                    note(verdicts, job, model, *best)
                print(f"{job.name}, {model}: {time.perf_counter() - started:.0f} s", file=sys.stderr, flush=True)
            is_build = job.modes in jobs.BUILDS
            print(f"\n### {job.name}\n\n{table(BUILD_HEADS if is_build else HEADS, rows)}", flush=True)
    summarise(verdicts)
    print(f"\n{load()}")


def load():
    """How busy the machine is: besides the one that is measured nobody should run."""
    return f"Load of the last 1, 5 and 15 minutes: {', '.join(f'{part:.1f}' for part in os.getloadavg())}; {os.cpu_count()} processors."


def note(verdicts, job, model, mode, peer, is_met):
    """One goal of a job with an RMS to keep may be reached by any tolerance; other goals stand for themselves."""
    if is_met is None:
        return
    part = "values" if job.rms and mode[0] == "values" else " ".join(mode)
    key = f"{job.name}, {model}, {part}, {peer}"
    verdicts[key] = verdicts.get(key, False) or is_met


def summarise(verdicts):
    missed = [key for key, is_met in verdicts.items() if not is_met]
    print(f"\n{len(verdicts) - len(missed)} of {len(verdicts)} goals met." + "".join(f"\n- not met: {key}" for key in missed))


class Bench:
    """Runs the contestants of one job on one model in turns, finds what is right and makes the rows."""

    def __init__(self, options, program, folder):
        self.options, self.program, self.folder = options, program, folder

    def run(self, job, model, path):
        from report import build_row, row

        shape, queries = self.prepare(job, path)
        contestants = [(mode, lambda mode=mode: self.ours(mode, job, path, queries)) for mode in job.modes]
        contestants += [(peer, lambda peer=peer: self.theirs(peer, path, queries)) for peer in job.peers]
        outcomes = self.take_turns(contestants)
        truth = self.truth(job, shape, path, queries, outcomes) if queries else None
        for mode in job.modes:
            for peer in job.peers:
                if queries:
                    cells, is_met = row(job, model, queries, mode, outcomes[mode], peer, outcomes[peer], truth)
                else:
                    cells, is_met = build_row(job, model, len(shape), mode, outcomes[mode], peer, outcomes[peer])
                yield cells, (mode, peer, is_met)

    def prepare(self, job, path):
        """The model, and the queries, which are written for the peers; None for a job that only builds."""
        import models

        shape = models.read(path)
        quick = self.options.quick
        queries = None
        if job.counts:
            queries = models.lattice(shape, min(job.counts, 24 if job.counts <= 100 else 32) if quick else job.counts)
        elif job.scattered:
            queries = models.scattered(shape, 20_000 if quick else job.scattered)
        elif job.plane:
            queries = models.plane(shape, 100 if quick else job.plane)
        if queries:
            queries.points.tofile(self.folder / "queries.f64")
        return shape, queries

    def take_turns(self, contestants):
        """Outcome of each: one run of every contestant in each round."""
        from report import Outcome, median_times

        results = {name: [] for name, _ in contestants}
        failures, answers = {}, {}
        for _ in range(self.options.rounds):
            for name, run in contestants:
                if name in failures:
                    continue
                try:
                    result, answers[name] = run()
                    results[name].append(result)
                except environment.Failed as failure:
                    failures[name] = str(failure)
        return {
            name: Outcome({}, failure=failures[name]) if name in failures
            else Outcome(median_times(results[name]), *answers[name])
            for name, _ in contestants
        }

    def ours(self, mode, job, path, queries):
        import numpy as np

        output = self.folder / "ours"
        command = [self.program, mode[0], path, *mode[1:], "--output", output]
        if job.counts:
            command += ["--counts", round(len(queries) ** (1 / 3))]
        elif queries:
            command += ["--points", self.folder / "queries.f64"]
        if self.options.quick:
            command += ["--repeats", 1, "--limit", 1]
        result = environment.run_measured(command, self.options.threads, OUR_TIME_LIMIT)
        if not queries:
            return result, ()
        has_values = mode[0] == "values"
        answers = np.fromfile(output, np.float64 if has_values else np.uint8)
        return result, (np.arange(len(queries)), answers, has_values)

    def theirs(self, peer, path, queries):
        import numpy as np

        output = self.folder / "theirs.f64"
        command = [sys.executable, THIS / "peers.py", peer, path, "--threads", self.options.threads, "--output", output]
        if queries:
            command += ["--points", self.folder / "queries.f64", "--chunk", queries.chunk, "--cap", PEER_CAP]
        result = environment.run_measured(command, self.options.threads)
        if not queries:
            return result, ()
        # Zeros and ones of a ray are no values of the winding number.
        return result, (queries.asked(result["stride"]), np.fromfile(output), peer != "open3d")

    def truth(self, job, shape, path, queries, outcomes):
        import truth

        done = [outcomes[mode] for mode in job.modes if not outcomes[mode].failure]
        ours = done[0].answers >= 0.5 if done else None
        values = [outcomes[peer] for peer in job.peers if not outcomes[peer].failure and outcomes[peer].has_values]
        is_cloud = path.suffix == ".f64"
        # Near 1/2 lie so many points of a cloud's field that only the samples are judged.
        references = [] if is_cloud else [(outcome.asked, outcome.answers) for outcome in values[:1]]
        budget = truth.BUDGET / (10 if self.options.quick else 1)
        sum_at = lambda places: truth.sum_directly(self.program, self.folder, path, queries.points[places])
        return truth.find(len(shape), queries, ours, references, budget, sum_at)


if __name__ == "__main__":
    main()
