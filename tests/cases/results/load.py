# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
#
# Loads results as a user would, with numpy, pandas or h5py. Prints of every column its first, eighth and
# last number as the hexadecimal digits of a float64, or the text:
#   load.py numpy|pandas|h5py FOLDER
import os
import struct
import sys


def show(table, name, value):
    if isinstance(value, bytes):
        value = value.decode()
    if isinstance(value, str):
        return value
    return struct.pack(">d", value).hex()


def show_column(table, name, unit, values):
    chosen = [values[0], values[min(7, len(values) - 1)], values[len(values) - 1]]
    print("\t".join([table, name, unit, str(len(values))] + [show(table, name, v) for v in chosen]))


def with_numpy(folder):
    import numpy

    for file in sorted(os.listdir(folder)):
        if file.endswith(".csv"):
            data = numpy.genfromtxt(
                os.path.join(folder, file), delimiter=",", names=True, dtype=None, encoding="utf-8",
                deletechars="", replace_space=" ")
            for name in data.dtype.names:
                show_column(file[:-4], name, "", numpy.atleast_1d(data[name]).tolist())


def with_pandas(folder):
    import pandas

    for file in sorted(os.listdir(folder)):
        if file.endswith(".csv"):
            data = pandas.read_csv(os.path.join(folder, file), float_precision="round_trip")
            for name in data:
                values = data[name].tolist()
                show_column(file[:-4], name, "", [v if isinstance(v, str) else float(v) for v in values])


def with_h5py(folder):
    import h5py

    with h5py.File(os.path.join(folder, "results.h5"), "r") as file:
        for table, group in file.items():
            if table == "summary":
                continue
            for name, column in group.items():
                assert column.chunks and column.compression == "gzip" and column.shuffle, name
                if len(column):
                    show_column(table, name, column.attrs["unit"], column[:].tolist())
        if "summary" in file:
            print("summary\t" + file["summary"][()].decode().replace("\n", " "))


def planes(folder):
    """Streams that the test wrote, as zlib sees them: STREAM.z is to be STREAM."""
    import zlib

    count = 0
    for file in sorted(os.listdir(folder)):
        if file.endswith(".z"):
            path = os.path.join(folder, file)
            with open(path, "rb") as packed, open(path[:-2], "rb") as plain:
                assert zlib.decompress(packed.read()) == plain.read(), file
            count += 1
    print("same", count)


{"numpy": with_numpy, "pandas": with_pandas, "h5py": with_h5py, "planes": planes}[sys.argv[1]](sys.argv[2])
