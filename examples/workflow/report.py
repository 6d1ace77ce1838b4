"""One line per recording: how many events have a modulus, and how their moduli are distributed."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas


def why_none(events, file):
    """Why no event has a modulus: what the program said of the recording, else the states of its events."""
    with open(file, encoding="utf-8") as lines:
        said = [line.removeprefix("# no moduli: ").strip() for line in lines if line.startswith("# no moduli: ")]
    return said[0] if said else ", ".join(f"{count} {state}" for state, count in events["state"].value_counts().items())


def described(name, file):
    events = pandas.read_csv(file, sep="\t", comment="#")
    modulus = events["young_modulus_kPa"].dropna()
    low, median, high = modulus.quantile([0.25, 0.5, 0.75]) if len(modulus) else [np.nan] * 3
    # Of the median of n values from a distribution with these quartiles (exact for normal ones).
    error = 1.2533 * (high - low) / 1.349 / np.sqrt(len(modulus)) if len(modulus) else np.nan
    return {"recording": name, "events": len(events), "with_modulus": len(modulus), "median_kPa": median,
            "standard_error_of_median_kPa": error, "lower_quartile_kPa": low, "upper_quartile_kPa": high,
            "without_moduli_because": "" if len(modulus) else why_none(events, file)}


def report(job):
    table = pandas.DataFrame([described(*pair) for pair in zip(job.params.names, job.input)])
    table.to_csv(job.output.table, sep="\t", index=False, float_format="%.6g")
    figure, axes = plt.subplots(figsize=(6, 1.2 + 0.35 * len(table)), layout="constrained")
    rows = np.arange(len(table))
    axes.hlines(rows, table["lower_quartile_kPa"], table["upper_quartile_kPa"], linewidth=5, alpha=0.4)
    axes.plot(table["median_kPa"], rows, "o")
    axes.set(xlabel="Young's modulus (kPa): median and quartiles", yticks=rows, yticklabels=table["recording"],
             ylim=(len(table) - 0.5, -0.5))
    figure.savefig(job.output.picture, dpi=150)


report(snakemake)  # noqa: F821 (the workflow gives it to its scripts)
