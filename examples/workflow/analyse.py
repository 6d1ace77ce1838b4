"""One command of rheocyte on one recording. That a recording has no moduli is a result, too, with the reason in the file."""

import shlex
import subprocess
import sys
from pathlib import Path

REFUSED, NOT_ALL = 2, 3  # exit codes: a sentence says why; there is a result, but not a complete one


def reason(said, recording):
    """What the program says about this recording; empty if something else is wrong, such as an option."""
    about = [line.removeprefix(f"{recording}: ") for line in said.splitlines() if line.startswith(f"{recording}: ")]
    return about[-1] if about else ""


def write_in_place(file, sentence):
    """A table without rows, or a picture, that says why there is nothing else."""
    if file.suffix == ".tsv":
        file.write_text(f"event\tyoung_modulus_kPa\tstate\n# no moduli: {sentence}\n", encoding="utf-8")
        return
    import matplotlib  # takes longer than many a recording

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure = plt.figure(figsize=(4, 1.5))
    figure.text(0.5, 0.5, f"{file.stem}: {sentence}", ha="center", va="center", wrap=True, fontsize=7)
    figure.savefig(file, dpi=150)


def analyse(job):
    recording, made = Path(job.input[0]), Path(job.output[0])
    ended = subprocess.run([*shlex.split(job.config["rheocyte"]), job.params.command, recording, "-o", job.params.target,
                            *shlex.split(job.params.options)], capture_output=True, text=True, check=False, errors="replace")
    Path(job.log[0]).write_text(ended.stdout + ended.stderr, encoding="utf-8")
    if ended.returncode in (0, NOT_ALL) and made.exists():
        return
    sentence = reason(ended.stderr, recording)
    if ended.returncode not in (REFUSED, NOT_ALL) or not sentence:
        sys.exit(ended.stderr or f"{job.params.command} ended with the exit code {ended.returncode}.")
    write_in_place(made, sentence)


analyse(snakemake)  # noqa: F821 (the workflow gives it to its scripts)
