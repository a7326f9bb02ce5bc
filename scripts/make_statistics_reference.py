#!/usr/bin/env python3
"""Writes tests/statistics/reference.json: SciPy's answers for the test cases of lib/base/statistics. Needs
python3-scipy (version 1.7 or later); the tests need only the file. Run it again after adding a case."""

import itertools
import json
import math
import pathlib

import numpy
import scipy
from scipy import optimize, stats

random = numpy.random.default_rng(1)
reference = {
    "origin": f"scripts/make_statistics_reference.py with SciPy {scipy.__version__} and NumPy {numpy.__version__}; "
    "Holm, Kaplan-Meier and exact tests with ties by their definitions there"
}


def numbers(values):
    """NaN as null, since JSON has none."""
    return [None if math.isnan(v) else float(v) for v in values]


# Distributions.
reference["normal_cdf"] = [
    {"z": z, "p": stats.norm.cdf(z)} for z in [-12, -6.5, -3, -2.0001, -1.96, -0.3, 0, 1e-3, 1.5, 2.5, 7]
]


def t_quantile(p, freedom):
    """SciPy 1.10's t.ppf has only ten digits; two steps of Newton's method give the rest."""
    t = stats.t.ppf(p, freedom)
    for _ in range(2):
        t -= (stats.t.cdf(t, freedom) - p) / stats.t.pdf(t, freedom)
    return t


reference["student_t_quantile"] = [
    {"p": p, "freedom": f, "t": t_quantile(p, f)}
    for p, f in itertools.product([0.6, 0.025, 0.975, 0.995, 0.0005], [1, 2, 7, 14.5, 29, 400])
]
reference["beta_cdf"] = [
    {"x": x, "a": a, "b": b, "p": stats.beta.cdf(x, a, b)}
    for a, b, x in [
        (0.5, 0.5, 0.1),
        (2, 3, 0.4),
        (10.5, 0.5, 0.97),
        (300.5, 700.5, 0.32),
        (3, 5000, 0.001),
        (1, 1, 0.7),
    ]
]
reference["log_gamma"] = [{"x": x, "value": math.lgamma(x)} for x in [1e-3, 0.5, 1, 1.5, 2, 7.25, 12, 100, 12345.5]]

# Rates.
counts = [(0, 1), (1, 1), (0, 10), (2, 10), (6, 10), (10, 10), (1, 300), (150, 300), (299, 300), (1234, 5000)]
intervals = []
for (k, n), confidence in itertools.product(counts, [0.95, 0.8]):
    tail = 0.5 - 0.5 * confidence
    row = {"successes": k, "trials": n, "confidence": confidence}
    ends = stats.binomtest(k, n).proportion_ci(confidence, method="wilson")
    row["wilson"] = [ends.low, ends.high]
    # binomtest's "exact" is the same by a search that ends at 2e-12.
    row["exact"] = [
        0.0 if k == 0 else stats.beta.ppf(tail, k, n - k + 1),
        1.0 if k == n else stats.beta.ppf(1 - tail, k + 1, n - k),
    ]
    row["jeffreys"] = [
        0.0 if k == 0 else stats.beta.ppf(tail, k + 0.5, n - k + 0.5),
        1.0 if k == n else stats.beta.ppf(1 - tail, k + 0.5, n - k + 0.5),
    ]
    intervals.append(row)
reference["intervals"] = intervals
reference["fisher"] = [
    {"counts": c, "p": stats.fisher_exact([[c[0], c[1] - c[0]], [c[2], c[3] - c[2]]])[1]}
    for c in [
        (6, 10, 2, 10),
        (10, 10, 6, 10),
        (9, 10, 2, 10),
        (3, 4, 1, 4),
        (0, 20, 7, 31),
        (50, 60, 101, 150),
        (7, 12, 3, 20),
        (180, 200, 160, 200),
        (0, 5, 0, 9),
    ]
]
reference["mcnemar"] = [
    {"only_first": a, "only_second": b, "p": stats.binomtest(a, a + b).pvalue}
    for a, b in [(0, 1), (0, 6), (3, 12), (5, 5), (14, 13), (40, 71), (0, 200), (1000, 1100)]
]

# Ranks.


def exact_signed_p(differences):
    """All signs of the average ranks are equally likely; twice the smaller tail."""
    d = numpy.array([x for x in differences if x != 0])
    ranks = stats.rankdata(abs(d))
    seen = ranks[d > 0].sum()
    sums = numpy.array([sum(c) for c in itertools.product(*[(0, r) for r in ranks])])
    return min(1.0, 2 * min((sums <= seen).mean(), (sums >= seen).mean()))


def exact_rank_sum_p(x, y):
    ranks = stats.rankdata(numpy.concatenate([x, y]))
    seen = ranks[: len(x)].sum()
    sums = numpy.array([sum(c) for c in itertools.combinations(ranks, len(x))])
    return min(1.0, 2 * min((sums <= seen + 1e-9).mean(), (sums >= seen - 1e-9).mean()))


signed = []
for n, shift in [(1, 0), (5, 0.4), (9, 0.8), (20, 0.2), (37, 0.3), (50, 0.5)]:
    d = numpy.round(random.normal(shift, 1, n), 6)
    signed.append({"differences": d.tolist(), "p": stats.wilcoxon(d, mode="exact").pvalue, "is_exact": True})
for d in [[1, 1, 1, 1, 1], [1, -1, 2, 2, 3, 0, 5], [3, 3, -1, 2, 2, 2, -2, 0, 0, 4, 5, 5]]:
    signed.append({"differences": d, "p": exact_signed_p(d), "is_exact": True})
for n, shift, digits in [(51, 0.2, 6), (80, 0.1, 1), (200, -0.15, 1)]:
    d = numpy.round(random.normal(shift, 1, n), digits)
    signed.append(
        {"differences": d.tolist(), "p": stats.wilcoxon(d, correction=True, mode="approx").pvalue, "is_exact": False}
    )
reference["wilcoxon"] = signed

sums = []
for n, m, shift in [(1, 4, 0), (5, 7, 1), (8, 8, 0.5), (20, 14, 0.4), (25, 25, 0.8)]:
    x, y = numpy.round(random.normal(shift, 1, n), 6), numpy.round(random.normal(0, 1, m), 6)
    sums.append(
        {"x": x.tolist(), "y": y.tolist(), "p": stats.mannwhitneyu(x, y, method="exact").pvalue, "is_exact": True}
    )
for x, y in [([1, 2, 2, 3], [2, 4, 4, 5, 6]), ([1, 1, 1], [1, 1]), ([0, 0, 0, 1, 5, 5], [5, 5, 6, 7, 7, 0])]:
    sums.append({"x": x, "y": y, "p": exact_rank_sum_p(x, y), "is_exact": True})
for n, m, shift, digits in [(40, 11, 0.3, 6), (100, 60, 0.3, 1), (30, 300, 0.1, 0)]:
    x, y = numpy.round(random.normal(shift, 1, n), digits), numpy.round(random.normal(0, 1, m), digits)
    sums.append(
        {"x": x.tolist(), "y": y.tolist(), "p": stats.mannwhitneyu(x, y, method="asymptotic").pvalue, "is_exact": False}
    )
reference["mann_whitney"] = sums


def holm(p):
    """Holm (1979): step down; the i-th smallest of m times m - i, never falling; NaN aside."""
    known = sorted((v, i) for i, v in enumerate(p) if not math.isnan(v))
    adjusted, last = list(p), 0.0
    for place, (value, i) in enumerate(known):
        last = max(last, min(1.0, (len(known) - place) * value))
        adjusted[i] = last
    return adjusted


reference["holm"] = [
    {"p": numbers(p), "adjusted": numbers(holm(p))}
    for p in [[0.01, 0.04, 0.03, 0.005], [0.5, math.nan, 0.001, 0.02, 0.02, 0.9], [0.2], [math.nan, math.nan]]
]

# Correlations.
correlations = []
for n, slope, digits in [(4, 1, 6), (12, 0.5, 6), (30, -0.8, 1), (200, 0.1, 0)]:
    x = numpy.round(random.normal(0, 1, n), digits)
    y = numpy.round(slope * x + random.normal(0, 1, n), digits)
    ends = stats.pearsonr(x, y).confidence_interval(0.95)
    r = stats.spearmanr(x, y)[0]
    half = stats.norm.ppf(0.975) * math.sqrt((1 + r * r / 2) / (n - 3))
    correlations.append(
        {
            "x": x.tolist(),
            "y": y.tolist(),
            "pearson": stats.pearsonr(x, y)[0],
            "pearson_interval": [ends.low, ends.high],
            "spearman": r,
            "spearman_interval": [math.tanh(math.atanh(r) - half), math.tanh(math.atanh(r) + half)],
        }
    )
reference["correlation"] = correlations

# The bootstrap: SciPy's BCa with as many draws that Monte Carlo does not show, as distributions differ.
clusters = numpy.round(random.lognormal(0, 0.8, 40), 4)
ends = stats.bootstrap(
    (clusters,), numpy.mean, n_resamples=200000, method="BCa", random_state=numpy.random.default_rng(2)
).confidence_interval
reference["bootstrap"] = {
    "values": clusters.tolist(),
    "bca": [ends.low, ends.high],
    "standard_deviation": clusters.std() / math.sqrt(40),
}

# Logistic curves: the likelihood maximised by BFGS and polished by Newton; Fisher's information inverted.
curves = []
for x, successes, trials in [
    ([1, 2, 3, 4, 5], [9, 8, 5, 2, 1], [10, 10, 10, 10, 10]),
    ([0.0, 0.2, 0.4, 0.6, 0.8, 1.0], [3, 0, 7, 9, 20, 19], [20, 1, 15, 12, 22, 20]),
    ([1000, 1001, 1002, 1003], [4, 3, 3, 1], [5, 5, 5, 5]),
    ([-3, -1, 0, 1, 2, 5], [0, 1, 0, 1, 1, 1], [1, 1, 1, 1, 1, 1]),
    ([1, 2, 3, 4], [11, 9, 12, 10], [20, 20, 20, 20]),
]:
    X, s, t = numpy.array(x, float), numpy.array(successes, float), numpy.array(trials, float)
    centre, scale = X.mean(), X.std()
    U = (X - centre) / scale

    def negative(b):
        return -(s * (b[0] + b[1] * U) - t * numpy.logaddexp(0, b[0] + b[1] * U)).sum()

    b = optimize.minimize(negative, [0, 0], method="BFGS").x
    design = numpy.stack([numpy.ones_like(U), U], axis=1)
    for _ in range(20):
        rate = 1 / (1 + numpy.exp(-design @ b))
        information = design.T @ (design * (t * rate * (1 - rate))[:, None])
        b = b + numpy.linalg.solve(information, design.T @ (s - t * rate))
    to_x = numpy.array([[1, -centre / scale], [0, 1 / scale]])
    coefficients, covariance = to_x @ b, to_x @ numpy.linalg.inv(information) @ to_x.T
    midpoint = -coefficients[0] / coefficients[1]

    def excess(m):  # of Fieller's test that the curve is at one half at m
        c = numpy.array([1, m])
        return (c @ coefficients) ** 2 - stats.norm.ppf(0.975) ** 2 * (c @ covariance @ c)

    ends = None
    if coefficients[1] ** 2 > stats.norm.ppf(0.975) ** 2 * covariance[1, 1]:
        span = 100 * scale * max(1, abs(midpoint - centre) / scale)
        ends = [
            optimize.brentq(excess, midpoint - span, midpoint, xtol=1e-13),
            optimize.brentq(excess, midpoint, midpoint + span, xtol=1e-13),
        ]
    curves.append(
        {
            "x": x,
            "successes": successes,
            "trials": trials,
            "intercept": coefficients[0],
            "slope": coefficients[1],
            "covariance": [covariance[0, 0], covariance[0, 1], covariance[1, 1]],
            "midpoint_interval": ends,
        }
    )
reference["logistic"] = curves


# Survival: Kaplan and Meier's product over the times of events, with Greenwood's sum.
def kaplan_meier(times, events):
    times, events = numpy.array(times, float), numpy.array(events, bool)
    rows, survival, greenwood = [], 1.0, 0.0
    for time in sorted(set(times[events])):
        at_risk, count = int((times >= time).sum()), int((events & (times == time)).sum())
        survival *= 1 - count / at_risk
        ends = [math.nan, math.nan]
        if survival > 0:
            greenwood += count / (at_risk * (at_risk - count))
            half = stats.norm.ppf(0.975) * math.sqrt(greenwood) / math.log(survival)
            ends = [survival ** math.exp(-half), survival ** math.exp(half)]
        rows.append(
            {"time_s": time, "survival": survival, "interval": numbers(ends), "at_risk": at_risk, "events": count}
        )
    return rows


samples = [([5, 3, 3, 8, 8, 1, 9, 12], [1, 1, 0, 1, 0, 0, 1, 1])]
times = numpy.round(random.exponential(10, 60))
samples.append((times.tolist(), (random.random(60) < 0.6).astype(int).tolist()))
reference["survival"] = [{"times_s": t, "is_event": e, "points": kaplan_meier(t, e)} for t, e in samples]


# Power of Fisher's test, by enumerating all outcomes.
def power(rate_1, rate_2, n, alpha=0.05):
    first, second = stats.binom.pmf(range(n + 1), n, rate_1), stats.binom.pmf(range(n + 1), n, rate_2)
    return sum(
        first[i] * second[j]
        for i in range(n + 1)
        for j in range(n + 1)
        if stats.fisher_exact([[i, n - i], [j, n - j]])[1] < alpha
    )


reference["power"] = [
    {"rates": [a, b], "trials": n, "power": power(a, b, n)}
    for a, b, n in [(0.9, 0.2, 9), (0.9, 0.2, 8), (0.9, 0.6, 40), (1.0, 0.7, 25), (0.5, 0.5, 30), (0.1, 0.4, 33)]
]


# Failures over the distance flown, maps as random effect: the posterior's moments on a grid. Effects of maps by
# Gauss-Hermite quadrature, the three parameters by sums over evenly spaced values. Priors as in failure_rate.hpp.
def failure_posterior(trials, asked):
    maps = sorted({row[0] for row in trials})
    hardness = numpy.array([next(x for m, x, _, _ in trials if m == number) for number in maps])
    centre, scale = hardness.mean(), hardness.std() or 1.0
    nodes, weights = numpy.polynomial.hermite_e.hermegauss(40)
    weights = weights / math.sqrt(2 * math.pi)
    log_rates = numpy.linspace(-18, 8, 209)[:, None, None, None]
    slopes = numpy.linspace(-6, 6, 61)[None, :, None, None]
    spreads = ((numpy.arange(30) + 0.5) / 30 * 4)[None, None, :, None]
    log_posterior = -0.5 * (((log_rates + math.log(100)) / 3) ** 2 + (slopes / 1.5) ** 2 + spreads**2)[..., 0]
    for number, x in zip(maps, (hardness - centre) / scale):
        rates = numpy.exp(log_rates + slopes * x + spreads * nodes)
        log_likelihood = 0.0
        for m, _, exposure, has_failed in trials:
            if m == number:
                mean = rates * exposure
                log_likelihood = log_likelihood + (numpy.log(-numpy.expm1(-mean)) if has_failed else -mean)
        log_posterior = log_posterior + numpy.log(numpy.maximum((numpy.exp(log_likelihood) * weights).sum(-1), 1e-300))
    posterior = numpy.exp(log_posterior - log_posterior.max())
    posterior /= posterior.sum()
    parts = {"log_rate": log_rates[..., 0], "slope": slopes[..., 0], "spread": spreads[..., 0]}
    moments = {name: float((posterior * part).sum()) for name, part in parts.items()}
    deviations = {
        name: math.sqrt(float((posterior * (part - moments[name]) ** 2).sum())) for name, part in parts.items()
    }
    predicted = []
    for x, exposure in asked:
        rates = numpy.exp(log_rates + slopes * (x - centre) / scale + spreads * nodes)
        rate = (posterior * (numpy.exp(-rates * exposure) * weights).sum(-1)).sum()
        predicted.append({"x": x, "exposure": exposure, "rate": float(rate)})
    return {"trials": trials, "mean": moments, "deviation": deviations, "predicted": predicted}


def flown(map_count, mission_count, log_rate, slope, spread):
    rows = []
    for number in range(map_count):
        x = round(float(random.uniform(0.3, 0.9)), 3)
        rate = math.exp(log_rate + slope * (x - 0.6) + spread * random.normal())
        for _ in range(mission_count):
            metres = round(float(random.uniform(10, 40)), 1)
            rows.append([number, x, metres, int(random.random() < 1 - math.exp(-rate * metres))])
    return rows


reference["failure_rate"] = [
    failure_posterior(rows, [(0.4, 20), (0.8, 20), (0.6, 100)])
    for rows in [
        flown(8, 6, math.log(0.02), -3.0, 0.5),
        flown(12, 5, math.log(0.006), -2.0, 1.0),
        flown(6, 5, math.log(1e-7), 0.0, 0.0),  # none fails
        flown(5, 4, math.log(2.0), 0.0, 0.0),  # all fail
    ]
]

path = pathlib.Path(__file__).resolve().parent.parent / "tests/statistics/reference.json"
lines = [
    f"{json.dumps(name)}: "
    + (
        json.dumps(value)
        if not isinstance(value, list)
        else "[\n  " + ",\n  ".join(json.dumps(row) for row in value) + "]"
    )
    for name, value in reference.items()
]
path.write_text("{\n" + ",\n".join(lines) + "\n}\n")
