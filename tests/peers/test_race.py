#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests what race.py makes of its measurements; nothing is run."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import race  # noqa: E402


def row(program, seconds, e, steps=20):
    """Unknowns grow with CPU seconds here."""
    return dict(program=program, steps=steps, unknowns=round(1000 * seconds),
                cpu_seconds=seconds, error_common=e, error_own=e)


class EqualError(unittest.TestCase):
    def test_power_law_is_reproduced(self):
        """seconds = 0.01 / error is a straight line in logarithms."""
        points = [(0.01 / e, e) for e in (0.1, 0.02, 0.003)]
        for e in (0.05, 0.01, 0.004):
            self.assertAlmostEqual(race.seconds_at(e, points), 0.01 / e, 12)

    def test_measured_points_are_met(self):
        points = [(1.0, 0.1), (7.0, 0.02), (9.0, 0.01)]
        for seconds, e in points:
            self.assertAlmostEqual(race.seconds_at(e, points), seconds, 12)

    def test_order_of_points_does_not_matter(self):
        points = [(1.0, 0.1), (4.0, 0.03), (20.0, 0.001)]
        self.assertEqual(race.seconds_at(0.01, points),
                         race.seconds_at(0.01, points[::-1]))

    def test_nothing_is_extrapolated(self):
        points = [(1.0, 0.1), (10.0, 0.01)]
        self.assertIsNone(race.seconds_at(0.2, points))
        self.assertIsNone(race.seconds_at(0.005, points))
        self.assertIsNone(race.seconds_at(0.01, []))
        self.assertIsNone(race.seconds_at(0.01, points[:1]))

    def test_worse_and_dearer_runs_do_not_count(self):
        good = [(1.0, 0.1), (10.0, 0.01)]
        self.assertEqual(race.front(good + [(2.0, 0.2), (11.0, 0.01)]), good)

    def test_ratio_needs_points_of_both_programs(self):
        """The peer takes ten times as long at each error; below 1 % it has no
        run, so there is no ratio either."""
        rows = [row("npt_dealii", 1e-2 / e, e) for e in (0.1, 0.02, 0.001)]
        rows += [row("CalculiX", 1e-1 / e, e) for e in (0.1, 0.008)]
        race.add_bounds(rows)
        levels = race.levels_table(rows)
        self.assertEqual([(line[0], line[1]) for line in levels],
                         [(reference, e) for reference in ("common", "own")
                          for e in (0.05, 0.02, 0.01)])
        for line in levels:
            self.assertAlmostEqual(line[4], 10.0, 10)


    def test_accidentally_small_errors_do_not_count(self):
        """The second mesh is better than the third by accident, and bounded by
        it; other steps and the other program do not matter."""
        rows = [row("CalculiX", t, e) for t, e in
                ((1.0, 0.1), (2.0, 0.001), (3.0, 0.02), (4.0, 0.01))]
        rows += [row("CalculiX", 5.0, 0.5, steps=10), row("npt_dealii", 5.0, 1.0)]
        race.add_bounds(rows)
        self.assertEqual([r["bound_common"] for r in rows],
                         [0.1, 0.02, 0.02, 0.01, 0.5, 1.0])
        self.assertEqual([r["front"] for r in rows], [1, 1, 0, 1, 0, 1])


class Curves(unittest.TestCase):
    def test_common_reference_is_as_far_from_both(self):
        def line(slope):
            return [(0.01 * k, 1.0, 1.0, slope * k) for k in range(21)]
        common = race.mean_curve(line(1.0), line(1.1))
        self.assertEqual(len(common), 11)
        self.assertAlmostEqual(race.error(line(1.0), common), 0.05 / 1.05, 12)
        self.assertAlmostEqual(race.error(line(1.1), common), 0.05 / 1.05, 12)

    def test_curves_are_compared_at_common_rows_only(self):
        """20 and 10 steps of a curved line have no difference."""
        fine, coarse = ([(h * k, 0.0, 0.0, (h * k)**2)
                         for k in range(round(0.2 / h) + 1)]
                        for h in (0.01, 0.02))
        self.assertAlmostEqual(race.error(coarse, fine), 0.0, 12)


class Processes(unittest.TestCase):
    def test_user_seconds_are_those_of_the_process(self):
        """Work counts, waiting does not; the exit status is handed on."""
        code = ("import os, sys, time\ntime.sleep(0.5)\n"
                "while os.times().user < 0.2: sum(range(1000))\nsys.exit(3)")
        with tempfile.TemporaryDirectory() as folder:
            status, seconds = race.user_seconds(
                [sys.executable, "-c", code], pathlib.Path(folder), "log")
        self.assertEqual(status, 3)
        self.assertGreater(seconds, 0.1)
        self.assertLess(seconds, 0.5)


if __name__ == "__main__":
    unittest.main()
