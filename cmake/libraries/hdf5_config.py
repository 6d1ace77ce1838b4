"""H5pubconf.h of HDF5 1.14: `hdf5_config.py emscripten|windows SOURCE TARGET`. Its own configuration links some 160
programs to find this out, which takes longer than compiling it, and runs some, which a cross-compiler cannot."""
import re
import sys
from pathlib import Path

# What all have; then what one of them has: wasm32-emscripten, x86_64-w64-mingw32.
COMMON = """DEV_T_IS_SCALAR HAVE_ASPRINTF HAVE_ATTRIBUTE HAVE_BUILTIN_EXPECT HAVE_DIRENT_H HAVE_FILTER_DEFLATE HAVE_FSEEKO
HAVE_GETTIMEOFDAY HAVE_LIBM HAVE_LIBZ HAVE_STDATOMIC_H HAVE_STRDUP HAVE_SYS_STAT_H HAVE_SYS_TIME_H HAVE_SYS_TYPES_H
HAVE_TIMEZONE HAVE_UNISTD_H HAVE_VASPRINTF HAVE_ZLIB_H IGNORE_DISABLED_FILE_LOCKS LDOUBLE_TO_LLONG_ACCURATE
LLONG_TO_LDOUBLE_CORRECT STDC_HEADERS WANT_DATA_ACCURACY WANT_DCONV_EXCEPTION"""
HAS = {
    "emscripten": """HAVE_ALARM HAVE_ARPA_INET_H HAVE_CLOCK_GETTIME HAVE_DLFCN_H HAVE_FCNTL HAVE_FEATURES_H HAVE_GETHOSTNAME
HAVE_GETRUSAGE HAVE_IOCTL HAVE_NETDB_H HAVE_NETINET_IN_H HAVE_PREADWRITE HAVE_PWD_H HAVE_STAT_ST_BLOCKS HAVE_STRCASESTR
HAVE_SYMLINK HAVE_SYS_FILE_H HAVE_SYS_IOCTL_H HAVE_SYS_RESOURCE_H HAVE_SYS_SOCKET_H HAVE_TMPFILE HAVE_TM_GMTOFF""",
    "windows": "HAVE_MINGW HAVE_WIN32_API HAVE_WINDOWS HAVE_WINDOW_PATH",
}
SIZES = {"BOOL": 1, "CHAR": 1, "DOUBLE": 8, "FLOAT": 4, "INT": 4, "LONG": 4, "LONG_DOUBLE": 16, "LONG_LONG": 8,
         "OFF64_T": 8, "OFF_T": 8, "SHORT": 2, "TIME_T": 8, "UNSIGNED": 4, "_FLOAT16": 0, "__FLOAT128": 0, "_QUAD": 0}
SIZES_OF_POINTERS = ("PTRDIFF_T", "SIZE_T", "SSIZE_T")
POINTER = {"emscripten": 4, "windows": 8}
TEXTS = {"DEFAULT_PLUGINDIR": '"/none"', "PACKAGE": '"hdf5"', "PACKAGE_NAME": '"HDF5"', "PACKAGE_STRING": '"HDF5"',
         "PACKAGE_TARNAME": '"hdf5"', "PACKAGE_BUGREPORT": '""', "PACKAGE_URL": '""', "PACKAGE_VERSION": '"1.14"',
         "VERSION": '"1.14"', "DEFAULT_VFD": "H5FD_SEC2"}


def size_of(system, name):
    """Of the type in SIZEOF_...; None for one that is not known here."""
    if name in SIZES_OF_POINTERS:
        return POINTER[system]
    whole = re.fullmatch(r"U?INT(_FAST|_LEAST)?(8|16|32|64)_T", name)
    if not whole:
        return SIZES.get(name)
    return max(int(whole[2]) // 8, 4) if whole[1] == "_FAST" and whole[2] == "16" else int(whole[2]) // 8


def value_of(system, name):
    """What stands behind the name, or None where it is not defined."""
    if name in COMMON.split() or name in HAS[system].split():
        return 1
    if name.startswith("SIZEOF_"):
        return size_of(system, name.removeprefix("SIZEOF_"))
    return TEXTS.get(name)


def main(system, source, target):
    lines = []
    with open(source, encoding="utf-8") as template:
        for line in template:
            found = re.match(r"\s*#\s*(?:cmakedefine(?:01)?|define)\s+H5_(\w+)", line)
            if found and ("cmakedefine" in line or "@" in line):
                value = value_of(system, found[1])
                line = f"/* H5_{found[1]} is not defined */\n" if value is None else f"#define H5_{found[1]} {value}\n"
            lines.append("" if "@" in line else line)
    text = "".join(lines)
    if not Path(target).exists() or Path(target).read_text(encoding="utf-8") != text:  # else all would be compiled anew
        Path(target).write_text(text, encoding="utf-8")


main(*sys.argv[1:])
