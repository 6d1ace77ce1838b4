"""The program's own help, taken apart: for man pages, completions, the pages of the documentation site and reviews."""
import re
import subprocess

COLUMN = 30  # where sentences begin


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True).stdout


def version_of(program):
    return subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]


def sections(text):
    """The lines of a help by their heading; "" for those before the first one, "Examples" for calls."""
    found, heading = {"": []}, ""
    for line in text.splitlines():
        if re.fullmatch(r"[A-Z][A-Za-z]+:", line):
            heading = line[:-1]
            found[heading] = []
        elif line.startswith("Usage:"):
            found["Usage"] = [line.split(":", 1)[1].strip()]
        elif line.startswith(("First steps:", "For example:")):
            found["Examples"] = line.split(":", 1)[1].strip().split("; ")
        else:
            found[heading].append(line)
    return found


def entries(lines):
    """Pairs of a name and its sentence; the sentence of a long name stands on the line below it."""
    found = []
    for line, below in zip(lines, [*lines[1:], ""]):
        if line.startswith("  ") and line[2:3].strip():
            name, _, sentence = line[2:].partition("  ")
            if not sentence and not below.startswith(COLUMN * " "):  # the name fills its column
                name, sentence = line[2:COLUMN], line[COLUMN:]
            found.append([name.strip(), sentence.strip()])
        elif found and line.strip():
            found[-1][1] = (found[-1][1] + " " + line.strip()).strip()
    return [_without_excluded(name, sentence) for name, sentence in found]


def commands(program):
    """Pairs of a command and its sentence."""
    return entries(sections(help_of(program))["Subcommands"])


def all_help(program, *command):
    """{name: help} of the program, its commands and theirs; "analytic-cell" of a command in a command."""
    text = help_of(program, *command)
    found = {"-".join(command) or "rheocyte": text}
    for name, _ in entries(sections(text).get("Subcommands", [])):
        found |= all_help(program, *command, name)
    return found


def _without_excluded(name, sentence):
    """The options that an option excludes stand behind its name; they belong to its sentence."""
    name, _, excluded = name.partition(" Excludes: ")
    return name, f"{sentence}; not together with {', '.join(excluded.split())}" if excluded else sentence
