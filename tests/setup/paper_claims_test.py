"""paper_claims_test.py REPOSITORY: verdicts of scripts/paper_claims.py follow from intervals, with unknown ends too."""

import sys

sys.path.insert(0, sys.argv[1] + "/scripts")
import paper_claims  # noqa: E402


def tables(*pairs):
    return {
        "planners": [
            {"planner": name, "finished_count": finished, "trial_count": 900}
            for name, finished in (("ego", 899), ("mbplanner", 900))
        ],
        "pairs": [
            {
                "planner": first,
                "other_planner": second,
                "contrast_factor_smoothed": value,
                "contrast_factor_smoothed_lower": lower,
                "contrast_factor_smoothed_upper": upper,
            }
            for first, second, value, lower, upper in pairs
        ],
    }


def check(got, expected):
    if got != expected:
        sys.exit(f"expected {expected}, got {got}")


check(paper_claims.equally_safe(tables(("ego", "mbplanner", 3.0, 1.0, None))), ("3.00 [1.00, –]", "?"))
check(paper_claims.equally_safe(tables(("mbplanner", "ego", 4.0, 2.0, None))), ("0.25 [–, 0.50]", "no"))
check(paper_claims.equally_safe(tables(("ego", "mbplanner", 1.1, 0.6, 1.9))), ("1.10 [0.60, 1.90]", "yes"))
check(
    paper_claims.safer_than_agile(tables(("agile", "ego", 9.0, 2.0, None), ("mbplanner", "agile", 0.1, 0.05, 0.5))),
    ("agile / ego 9.00 [2.00, –]; agile / mbplanner 10.00 [2.00, 20.00]", "yes"),
)
check(
    paper_claims.safer_than_agile(tables(("agile", "ego", 9.0, 1.0, None), ("agile", "mbplanner", 9.0, 2.0, 20.0))),
    ("agile / ego 9.00 [1.00, –]; agile / mbplanner 9.00 [2.00, 20.00]", "?"),
)
