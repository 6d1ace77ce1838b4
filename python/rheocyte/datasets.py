"""Open datasets of dclab as recordings: with their own events and metadata, also where a file says something else.

What equals a file is read from that file. Children of a file, and datasets whose metadata were changed, become a small
recording for the time of the work, which refers to the file by a map of events; what is in no file is copied.
"""

import os
import tempfile
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from rheocyte.errors import UserError, in_words_of_python
from rheocyte.native_module import native
from rheocyte.paths import path
from rheocyte.tables_of_events import as_text, is_frame, is_parquet

_SECTIONS = ("experiment", "imaging", "setup", "user")
# They name the measurement: with another name a file would not be taken as the origin of the events.
_IDENTITY = ("experiment:run identifier", "experiment:time")
_COUNT = "experiment:event count"
_MASKS_AT_A_TIME = 200


class Source:
    """A recording that can be read by its place; `name` stands for it in texts."""

    def __init__(self, place, name=None, warnings=()):
        self.place, self.name, self.warnings = place, name or place, list(warnings)

    def named(self, text):
        """A text with the recording's name; other files beside the recording are where the recording is."""
        text = text.replace(self.place, self.name)
        return text.replace(*(os.path.join(os.path.dirname(each), "") for each in (self.place, self.name)))

    def told(self, sentences):
        """Sentences about this recording, in words of Python."""
        return [in_words_of_python(self.named(sentence)) for sentence in sentences]


@contextmanager
def source_of(given, gated=()):
    """The Source of a path, dataset or table; `gated` are features that it must hold if the dataset has them."""
    if is_frame(given) or is_parquet(given):
        with as_text(given) as (place, name, warnings):
            yield from _under_its_name(Source(place, name, warnings))
        return
    if not hasattr(given, "config"):
        if not given and isinstance(given, str):
            raise UserError("the recording is '', which is not a path of a file.")
        yield Source(path(getattr(given, "path", given), "the recording"))
        return
    root, events = _origin(given)
    stored = _stored_metadata(root)
    missing = [] if stored is None else [feature for feature in gated if _is_only_in_memory(root, feature)]
    if given is root and not missing and stored is not None and not _changes(given.config, stored):
        yield Source(path(root.path, "the recording"))
        return
    with tempfile.TemporaryDirectory(prefix="rheocyte-") as folder:
        source = Source(str(Path(folder) / "dataset.rtdc"), _name(root))
        file = native.RecordingFile(source.place)
        _write_metadata(file, given.config, stored)
        if stored is None:
            source.warnings += _write_events(file, given, gated)
        else:
            file.append("basinmap0", events)
            file.add_basin(os.path.abspath(root.path), "basinmap0")
            for feature in missing:
                file.append(feature, _column(given, feature))
        for name in given.logs.keys():
            file.add_log(name, [str(line) for line in given.logs[name]])
        file.close()
        yield from _under_its_name(source)


def _under_its_name(source):
    """The source, for errors that call it by its name."""
    try:
        yield source
    except UserError as error:
        raise UserError(source.named(str(error))) from None


def _origin(dataset):
    """The dataset of which this one is a part, and which of its events are here."""
    events = np.arange(len(dataset))
    if not len(events):
        raise UserError(f"{_name(dataset)}: the dataset has no events.")
    root = dataset
    while hasattr(root, "hparent"):
        kept = np.flatnonzero(root.hparent.filter.all)
        if len(kept) != len(root):
            raise UserError(f"{_name(dataset)}: a filter has changed since; call rejuvenate() of the dataset first.")
        events, root = kept[events], root.hparent
    return root, events


def _name(dataset):
    is_path = isinstance(dataset.path, (str, os.PathLike)) and os.path.isfile(dataset.path)
    return os.fspath(dataset.path) if is_path else f"the dataset {dataset.title}"


def _stored_metadata(root):
    """Metadata of the dataset's file as they are stored; None if it is not a file that can be read here."""
    if getattr(root, "format", "") != "hdf5" or not isinstance(root.path, (str, os.PathLike)):
        return None
    import h5py

    try:
        with h5py.File(root.path, "r", locking=False) as file:
            found = {key: value.decode("utf-8", "replace") if isinstance(value, bytes) else value
                     for key, value in file.attrs.items()}
    except OSError:  # it has gone since
        return None
    return {key: value for key, value in found.items() if isinstance(value, str) or np.ndim(value) == 0}


def _metadata(config):
    return {f"{section}:{key}": value for section in _SECTIONS if section in config
            for key, value in config[section].items()}


def _changes(config, stored):
    """Values of the configuration that are not those of the file, None for those that were taken out."""
    ours = _metadata(config)
    changes = {key: value for key, value in ours.items() if key not in stored or not _is_same(value, stored[key])}
    taken_out = {key: None for key in stored if key not in ours and stored[key] != "" and _is_known(key)}
    return {key: value for key, value in {**changes, **taken_out}.items() if key != _COUNT}


def _is_same(a, b):
    try:
        return float(a) == float(b)
    except (TypeError, ValueError):
        return str(a).lower() == str(b).lower()


def _is_known(key):
    """Whether dclab keeps it: of a key that it does not know, its configuration says nothing."""
    from dclab import definitions

    section, _, name = key.partition(":")
    return section in _SECTIONS and (section == "user" or definitions.config_key_exists(section, name))


def _write_metadata(file, config, stored):
    merged = dict(stored or {})
    merged.update(_changes(config, merged))
    for key, value in merged.items():
        if value is None or key == _COUNT or (stored is not None and key in _IDENTITY):
            continue
        if isinstance(value, (bool, np.bool_, int, np.integer)):
            file.add_metadata(key, int(value))
        elif isinstance(value, (float, np.floating)):
            file.add_metadata(key, float(value))
        else:
            file.add_metadata(key, str(value))


def _is_only_in_memory(dataset, feature):
    return feature in dataset and feature not in (*dataset.features_innate, *dataset.features_basin)


def _column(dataset, feature):
    column = np.asarray(dataset[feature], dtype=float)
    if column.shape != (len(dataset),):
        raise UserError(f"{_name(dataset)}: {feature} has the shape {column.shape} for {len(dataset)} events.")
    return column


def _write_events(file, dataset, gated):
    """All that is stored of the events, and masks; sentences on what was left out."""
    stored = {*dataset.features_innate, *dataset.features_basin}
    for feature in sorted({*stored, *(name for name in gated if name in dataset)} & {*dataset.features_scalar}):
        file.append(feature, _column(dataset, feature))
    if "mask" in dataset:
        masks = dataset["mask"]
        for first in range(0, len(dataset), _MASKS_AT_A_TIME):
            events = range(first, min(first + _MASKS_AT_A_TIME, len(dataset)))
            file.append_masks(np.stack([np.asarray(masks[i], dtype=bool) for i in events]).view(np.uint8))
    elif "contour" in stored:
        return ["the contours are not read, for this dataset is not one of an .rtdc file and has no masks."]
    return []
