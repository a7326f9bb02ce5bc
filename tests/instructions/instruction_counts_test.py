#!/usr/bin/env python3
"""The gate itself: what it lets pass and what it does not."""

import unittest

from instruction_counts import TOLERANCE, compare


class Gate(unittest.TestCase):
    def wrong(self, now):
        return compare({"step": now}, {"step": 1000.0})[1]

    def test_lets_pass_what_is_within_the_tolerance(self):
        self.assertEqual(self.wrong(1000 * (1 + 0.9 * TOLERANCE)), [])
        self.assertEqual(self.wrong(1000 * (1 - 0.9 * TOLERANCE)), [])

    def test_refuses_more(self):
        self.assertIn("+4.0% instructions, more than 3%", self.wrong(1040)[0])

    def test_asks_to_keep_a_gain(self):
        self.assertIn("Bless it", self.wrong(900)[0])

    def test_refuses_work_that_is_on_one_side_only(self):
        self.assertIn("no count is blessed", compare({"new": 1.0}, {})[1][0])
        self.assertIn("no such work", compare({}, {"gone": 1.0})[1][0])


if __name__ == "__main__":
    unittest.main()
