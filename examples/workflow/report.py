"""One line per recording: the modulus that `rheocyte extract` recommends to report, or why none, then those from deformation."""

import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas

REFUSED, RECOMMENDED = "# no moduli: ", "# recommended_"  # lines of analyse.py and of `rheocyte extract`
MEDIAN = "recommended_young_modulus_median_kPa"
ERRORS = "recommended_young_modulus_median_kPa_error", "recommended_young_modulus_median_kPa_common_error"


def remarks(file, beginning):
    """The remarks in a table of events that begin so, without that."""
    with open(file, encoding="utf-8") as lines:
        return [line.removeprefix(beginning).strip() for line in lines if line.startswith(beginning)]


def why_none(events, file):
    """Why no event has a modulus: what the program said of the recording, else the states of its events."""
    said = remarks(file, REFUSED)
    return said[0] if said else ", ".join(f"{count} {state}" for state, count in events["state"].value_counts().items())


def number_or_text(text):
    try:
        return float(text)
    except ValueError:
        return text


def recommended(events, file):
    """What the program recommends to report, by the names of the summary table; without a number it says why."""
    said = {"recommended_modulus": "none", MEDIAN: np.nan, **dict.fromkeys(ERRORS, np.nan), "recommended_text": ""}
    for line in remarks(file, RECOMMENDED):
        name, text = line.split(": ", 1)
        said[f"recommended_{name}"] = number_or_text(text)
    if np.isnan(said[MEDIAN]) and not said["recommended_text"]:
        said["recommended_text"] = why_none(events, file)
    return said


def described(name, file):
    events = pandas.read_csv(file, sep="\t", comment="#")
    modulus = events["young_modulus_kPa"].dropna()
    low, median, high = modulus.quantile([0.25, 0.5, 0.75]) if len(modulus) else [np.nan] * 3
    # Of the median of n values from a distribution with these quartiles (exact for normal ones).
    error = 1.2533 * (high - low) / 1.349 / np.sqrt(len(modulus)) if len(modulus) else np.nan
    return {"recording": name, **recommended(events, file), "events": len(events),
            "with_modulus_from_deformation": len(modulus), "deformation_median_kPa": median,
            "deformation_median_kPa_error": error, "deformation_first_quartile_kPa": low,
            "deformation_third_quartile_kPa": high, "without_moduli_because": "" if len(modulus) else why_none(events, file)}


def draw_recommended(axes, table):
    rows, numbers = np.arange(len(table)), table[MEDIAN]
    error = np.sqrt((table[list(ERRORS)].fillna(0) ** 2).sum(axis=1))
    axes.errorbar(numbers, rows, xerr=error, fmt="o", capsize=3, label="recommended, with its errors")
    for row, text in zip(rows[numbers.isna()], table["recommended_text"][numbers.isna()]):
        axes.annotate(textwrap.shorten(f"none: {text}", 110, placeholder=" …"), (0.01, row), (0, 9), ha="left", va="center",
                      xycoords=axes.get_yaxis_transform(), textcoords="offset points", fontsize=6)


def report(job):
    table = pandas.DataFrame([described(*pair) for pair in zip(job.params.names, job.input)])
    table = table[sorted(table, key=lambda name: name != "recording" and 1 + (not name.startswith("recommended_")))]
    table.to_csv(job.output.table, sep="\t", index=False, float_format="%.6g")
    figure, axes = plt.subplots(figsize=(7, 1.8 + 0.4 * len(table)), layout="constrained")
    rows = np.arange(len(table))
    axes.hlines(rows, table["deformation_first_quartile_kPa"], table["deformation_third_quartile_kPa"], linewidth=5,
                color="0.7", alpha=0.5, zorder=1)
    axes.plot(table["deformation_median_kPa"], rows, "|", color="0.4", markersize=9, zorder=1,
              label="from deformation: median and quartiles")
    draw_recommended(axes, table)
    axes.set(xlabel="Young's modulus (kPa)", yticks=rows, yticklabels=table["recording"], ylim=(len(table) - 0.5, -0.5))
    figure.legend(loc="outside lower center", ncol=2, frameon=False, fontsize=7)
    figure.savefig(job.output.picture, dpi=150)


report(snakemake)  # noqa: F821 (the workflow gives it to its scripts)
