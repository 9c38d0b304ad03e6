"""What is right: the direct sum in f64 where it is affordable, agreement of two independent ways elsewhere."""
import os
from dataclasses import dataclass

import numpy as np

from environment import run_measured

# Solid angles to sum for each job and model: about 15 seconds of one processor.
BUDGET = 1e9
LEAST_SAMPLES = 1000
# Values this near 1/2 are looked at again: about four times the largest error of the peers on organic models.
DOUBTFUL = 0.02
# Ties: nothing is right or wrong there.
TIE = 1e-9
UNKNOWN = -1
SEED = 11


@dataclass
class Truth:
    # Places of the random samples and the exact values there: for RMS and maximum.
    places: np.ndarray
    exact: np.ndarray
    # For each query 0 or 1, or UNKNOWN.
    inside: np.ndarray
    skipped: int
    # Doubtful places beyond the budget, which were not looked at: their labels stay unknown.
    left: int


def sum_directly(program, folder, model, points):
    np.ascontiguousarray(points).tofile(folder / "oracle.points")
    command = [program, "oracle", model, "--points", folder / "oracle.points", "--output", folder / "oracle.f64"]
    # On every processor: it is not measured.
    run_measured(command, os.cpu_count())
    return np.fromfile(folder / "oracle.f64")


def find(elements, queries, ours, references, budget, sum_at):
    """The truth about `queries`.

    `ours` classifies all of them (or is None), `references` are pairs of places and values of other implementations:
    where both agree and the value is not doubtful, that is taken as right. `sum_at` sums directly at places.
    """
    random = np.random.default_rng(SEED)
    affordable = int(max(budget / elements, LEAST_SAMPLES))
    samples = np.sort(random.permutation(len(queries))[:affordable])
    inside = np.full(len(queries), UNKNOWN, np.int8)
    doubtful = np.zeros(len(queries), bool)
    for asked, values in references:
        clear = np.abs(values - 0.5) >= DOUBTFUL
        agreed = clear & (ours[asked] == (values >= 0.5)) if ours is not None else np.zeros_like(clear)
        inside[asked[agreed]] = ours[asked[agreed]] if ours is not None else UNKNOWN
        doubtful[asked[~agreed]] = True
    inside[doubtful] = UNKNOWN
    doubtful[samples] = False
    doubts = np.flatnonzero(doubtful)
    looked = random.permutation(doubts)[:affordable] if ours is not None else doubts[:0]
    places = np.concatenate([samples, looked])
    exact = sum_at(places)
    tie = np.abs(exact - 0.5) < TIE
    inside[places] = np.where(tie, UNKNOWN, exact >= 0.5)
    return Truth(samples, exact[: len(samples)], inside, int(tie.sum()), len(doubts) - len(looked))
