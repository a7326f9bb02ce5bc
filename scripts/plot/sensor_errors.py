#!/usr/bin/env python3
"""Draws sensors' errors as a value changes, from `avoidbench sensors measure … --over PATH=VALUES --format csv`.

usage: sensor_errors.py ERRORS.csv FIGURE.png|pdf|svg

Three panels over the value: valid pixels, disparity errors beyond 1 px, and the deviation of the others. Pixels near
edges are left out."""

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402
import pandas  # noqa: E402
import style  # noqa: E402

PANELS = [("valid_pct", "valid (%)"), ("outlier_pct", "beyond 1 px (%)"), ("sigma_px", "deviation (px)")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("errors", type=pathlib.Path)
    parser.add_argument("figure", type=pathlib.Path)
    arguments = parser.parse_args()
    errors = pandas.read_csv(arguments.errors)
    value = errors.columns[0]
    if value == "sensor":
        parser.error(f"{arguments.errors}: no value is swept: measure with --over PATH=VALUES")
    errors = errors[errors["where"].str.startswith("all ")]
    sensors = list(dict.fromkeys(errors["sensor"]))
    style.apply()
    figure, panels = pyplot.subplots(len(PANELS), 1, figsize=(style.COLUMN_IN, 4.6), sharex=True)
    for axes, (column, label) in zip(panels, PANELS):
        for sensor, look in style.looks(sensors).items():
            rows = errors[errors["sensor"] == sensor].sort_values(value)
            axes.plot(rows[value], rows[column], **look)
        axes.set_ylabel(label)
        axes.set_ylim(bottom=0)
    panels[-1].set_xlabel(value.replace("_", " "))
    style.planner_legend(panels[0], sensors, style.COLUMN_IN)
    style.save(figure, arguments.figure)


if __name__ == "__main__":
    main()
