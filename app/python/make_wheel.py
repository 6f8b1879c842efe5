"""Packs the built package palpa into a wheel for pip.

A wheel is a zip file with the package and a folder of metadata (PEP 427); the standard library suffices.
The build of the module is the business of CMake (docs/decisions/049-python-package.md).
"""

import argparse
import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile

METADATA = """Metadata-Version: 2.1
Name: palpa
Version: {version}
Summary: Model elastic solids with spline patches and touch them as real elastic bodies
Requires-Python: =={python}.*
Requires-Dist: numpy >=1.21
Provides-Extra: hdf5
Requires-Dist: h5py ; extra == "hdf5"
License-File: LICENSE
"""

WHEEL = """Wheel-Version: 1.0
Generator: palpa make_wheel.py
Root-Is-Purelib: false
Tag: {tag}
"""

# The earliest time that a zip file can store: equal contents give equal files.
TIME = (1980, 1, 1, 0, 0, 0)


def tag_of_interpreter() -> str:
    """As cp311-cp311-linux_x86_64: this interpreter and this kind of machine."""
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def record_line(name: str, content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def pack(package: pathlib.Path, version: str, licence: pathlib.Path, folder: pathlib.Path) -> pathlib.Path:
    """Writes the wheel into a folder and returns its path."""
    tag = tag_of_interpreter()
    info = f"palpa-{version}.dist-info"
    python = f"{sys.version_info[0]}.{sys.version_info[1]}"
    files = {
        f"palpa/{file.name}": (file.read_bytes(), file.stat().st_mode & 0o777)
        for file in sorted(package.iterdir())
        if file.is_file()
    }
    files[f"{info}/LICENSE"] = (licence.read_bytes(), 0o644)
    files[f"{info}/METADATA"] = (METADATA.format(version=version, python=python).encode(), 0o644)
    files[f"{info}/WHEEL"] = (WHEEL.format(tag=tag).encode(), 0o644)
    record = "".join(record_line(name, content) for name, (content, _) in files.items())
    files[f"{info}/RECORD"] = (f"{record}{info}/RECORD,,\n".encode(), 0o644)

    wheel = folder / f"palpa-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, (content, mode) in files.items():
            entry = zipfile.ZipInfo(name, TIME)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100000 | mode) << 16
            archive.writestr(entry, content)
    return wheel


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--package", type=pathlib.Path, required=True, help="folder of the built package")
    parser.add_argument("--version", required=True)
    parser.add_argument("--license", type=pathlib.Path, required=True)
    parser.add_argument("--to", type=pathlib.Path, required=True, help="folder of the wheel")
    options = parser.parse_args()
    print(pack(options.package, options.version, options.license, options.to))


if __name__ == "__main__":
    main()
