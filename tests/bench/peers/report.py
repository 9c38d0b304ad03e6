"""Results as Markdown."""
import statistics
from dataclasses import dataclass

import numpy as np

from jobs import mode_name
from truth import UNKNOWN

HEADS = (
    "job", "model", "asked", "ours", "peer", "peer's time", "our time", "ratio", "goal", "RMS theirs / ours",
    "our max error", "wrong theirs / ours", "checked", "skipped ties", "met",
)
BUILD_HEADS = (
    "model", "triangles", "peer", "peer's time", "our time", "ratio", "goal", "peer: memory kept / peak / whole process",
    "ours: kept / peak / whole process", "our field's bytes", "bytes a triangle", "kept ours / theirs", "met",
)
KEYS = ("build", "evaluation", "total", "resident", "peak", "process", "bytes")


@dataclass
class Outcome:
    """What one contestant did: medians over the rounds, the answers of the last, or why it failed."""

    times: dict
    # Places of the queries asked, and the answers: values, or 0 and 1.
    asked: np.ndarray | None = None
    answers: np.ndarray | None = None
    has_values: bool = False
    failure: str | None = None


def median_times(results):
    return {key: statistics.median(r[key] for r in results) for key in KEYS if key in results[0]} | {
        "stride": results[-1].get("stride", 1),
    }


def seconds(time, stride=1):
    text = f"{1e3 * time:.3g} ms" if time < 1 else f"{time:.3g} s"
    return text + (f" (scaled from 1 in {stride})" if stride > 1 else "")


def megabytes(bytes_):
    return f"{bytes_ / 1e6:.1f}"


def memory_cell(times):
    return " / ".join(megabytes(times[key]) for key in ("resident", "peak", "process")) + " MB"


def errors(outcome, truth):
    """RMS and maximum of the error at the samples that were asked; None without values."""
    if not outcome.has_values or truth is None:
        return None, None
    values = np.full(len(truth.inside), np.nan)
    values[outcome.asked] = outcome.answers
    difference = values[truth.places] - truth.exact
    difference = difference[~np.isnan(difference)]
    if not len(difference):
        return None, None
    return float(np.sqrt(np.mean(difference**2))), float(np.abs(difference).max())


def wrong(outcome, truth):
    """Misclassified among the asked whose truth is known, and how many those are."""
    right = truth.inside[outcome.asked]
    known = right != UNKNOWN
    return int(((outcome.answers >= 0.5) != right)[known].sum()), int(known.sum())


def row(job, model, queries, mode, ours, peer, theirs, truth):
    """Cells of the table for one mode of ours beside one peer, and whether the goal is met (None: there is none)."""
    goal = job.goals.get((mode, peer))
    head = [job.name, model, queries.name, mode_name(mode), peer]
    failure = theirs.failure or ours.failure
    if failure:
        who = peer if theirs.failure else "ours"
        missed = goal is not None and ours.failure is not None
        return head + ["–", "–", "–", goal_cell(goal), *["–"] * 5, f"{who}: {failure}"], False if missed else None
    key = "evaluation" if job.prepared else "total"
    ratio = theirs.times[key] / ours.times[key]
    (their_rms, _), (our_rms, our_max) = errors(theirs, truth), errors(ours, truth)
    (their_wrong, their_checked), (our_wrong, checked) = wrong(theirs, truth), wrong(ours, truth)
    # A peer that was asked in part of the places is judged there.
    of = f" of {their_checked}" if their_checked < checked else ""
    reasons = []
    if goal and ratio < goal:
        reasons.append("ratio")
    # A cloud has no certified classification: its goal is the RMS.
    if not model.startswith("cloud") and (mode[0] != "values" or mode[-1] == "0") and our_wrong:
        reasons.append("wrong")
    if job.rms and None not in (their_rms, our_rms) and our_rms > their_rms:
        reasons.append("RMS")
    if our_max is not None and our_max > job.errors.get(mode, np.inf):
        reasons.append("error")
    # The bound on our error is no matter between peers: it is judged once.
    is_judged = goal or (mode in job.errors and peer == job.peers[0])
    is_met = not reasons if is_judged else None
    unsure = f" ({truth.left} doubtful not looked at)" if truth.left else ""
    return head + [
        seconds(theirs.times[key], theirs.times["stride"]), seconds(ours.times[key]), f"{ratio:.3g} ×", goal_cell(goal),
        f"{number(their_rms)} / {number(our_rms)}", number(our_max), f"{their_wrong}{of} / {our_wrong}", f"{checked}{unsure}",
        str(truth.skipped), verdict(is_met, reasons),
    ], is_met


def goal_cell(goal):
    return f"≥ {goal} ×" if goal else "–"


def number(value):
    return "–" if value is None else f"{value:.1e}"


def verdict(is_met, reasons):
    return "" if is_met is None else "yes" if is_met else "**no**: " + ", ".join(reasons)


def build_row(job, model, elements, mode, ours, peer, theirs):
    goal = job.goals.get((mode, peer))
    failure = theirs.failure or ours.failure
    if failure:
        return [model, str(elements), peer, *["–"] * 9, failure], False if goal and ours.failure else None
    ratio = theirs.times["build"] / ours.times["build"]
    share = ours.times["resident"] / max(theirs.times["resident"], 1)
    reasons = [name for name, fails in (("ratio", goal and ratio < goal), ("memory", goal and share > job.memory)) if fails]
    is_met = not reasons if goal else None
    return [
        model, f"{elements:,}", peer, seconds(theirs.times["build"]), seconds(ours.times["build"]), f"{ratio:.3g} ×",
        goal_cell(goal), *(memory_cell(outcome.times) for outcome in (theirs, ours)),
        f"{megabytes(ours.times['bytes'])} MB", f"{ours.times['bytes'] / elements:.0f}", f"{share:.2f}",
        verdict(is_met, reasons),
    ], is_met


def table(heads, rows):
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
