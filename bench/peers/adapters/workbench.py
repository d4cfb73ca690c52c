#!/usr/bin/env python3
"""The Connectome Workbench: wb_command -surface-geodesic-distance, once a source; it reads .surf.gii."""
import base64
import os
import re
import subprocess
import sys
import tempfile
import zlib

import numpy as np

from common import arguments, write

program, domain, sources, out = arguments(4)
quiet = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "OMP_NUM_THREADS": "1"}


def numbers(name):
    """The one array of a .func.gii, in whichever of the encodings it is."""
    with open(name, encoding="ascii") as file:
        text = file.read()
    data = text.split("<Data>")[1].split("</Data>")[0]
    encoding = re.search(r'Encoding="(\w+)"', text)[1]
    if encoding == "ASCII":
        return np.array(data.split(), float)
    raw = base64.b64decode(data)
    if encoding == "GZipBase64Binary":
        raw = zlib.decompress(raw)
    return np.frombuffer(raw, "<f4").astype(float)


def row(source, metric):
    done = subprocess.run([program, "-surface-geodesic-distance", domain, str(source), metric], env=quiet,
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit((done.stderr or done.stdout).strip() or f"{program} ended with {done.returncode}")
    found = numbers(metric)
    return np.where(found < 0, np.inf, found)  # -1: no path


with tempfile.TemporaryDirectory() as folder:
    write(out, (row(source, os.path.join(folder, "d.func.gii")) for source in sources))
