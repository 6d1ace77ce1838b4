"""One page for each command of the program, from its own help."""
import re

from help_texts import commands, entries, help_of, sections
from restructured_text import code, contents, entry, sentence, table_of_links, title

TITLES = {"Positionals": "Arguments", "Options": "Options"}
# What CLI11 prints: names, what is to be given, its default.
FORM = re.compile(r"(?P<names>\S+?)(?: (?P<form>.*?)(?:=(?P<default>[^A-Z=]+))?(?P<required> REQUIRED)?)?")


def option(name, text):
    """An option with all its names, which search finds."""
    names, form, default, required = FORM.fullmatch(name).group("names", "form", "default", "required")
    if default and form == form.lower():  # --set key=value
        form, default = f"{form}={default}", None
    forms = ", ".join(f"{each} {form or ''}".strip() if each.startswith("--") else each for each in names.split(","))
    more = (" Required." if required else "") + (f" Default: ``{default}``." if default else "")
    return f".. option:: {forms}\n\n   {sentence(text)}{'.' if more else ''}{more}\n\n"


def argument(name, text):
    return entry(name.replace(" TEXT", "").replace(" PATH", "").split(":{")[0].replace(" REQUIRED", ""), sentence(text))


def body(program, *command):
    """Usage, arguments and options of a command, and the same of its subcommands."""
    help_text = sections(help_of(program, *command))
    said = sentence(" ".join(help_text[""]))
    text = f"{said[:1].upper()}{said[1:]}.\n\n"
    text += code("\n".join(help_text["Usage"]), "text") + f".. program:: rheocyte {' '.join(command)}\n\n"
    for heading, write in (("Positionals", argument), ("Options", option)):
        if listed := entries(help_text.get(heading, [])):
            text += f".. rubric:: {TITLES[heading]}\n\n" + "".join(write(*each) for each in listed)
    if help_text.get("Examples"):
        calls = "\n".join(re.sub(r" \(see [^)]*\)$", "", call) for call in help_text["Examples"])
        text += ".. rubric:: Examples\n\n" + code(calls, "bash")
    for name, _ in entries(help_text.get("Subcommands", [])):
        text += title(f"rheocyte {' '.join(command)} {name}", "-") + body(program, *command, name)
    return text


def pages(program):
    """{file: text} of the pages, with an index."""
    listed = commands(program)
    rows = [(name, f"rheocyte {name}", text) for name, text in listed]
    index = title("Commands") + "What ``rheocyte COMMAND --help`` prints.\n\n" + table_of_links(rows)
    index += contents(name for name, _ in listed)
    found = {"commands/index.rst": index}
    for name, _ in listed:
        found[f"commands/{name}.rst"] = title(f"rheocyte {name}") + body(program, name)
    return found
