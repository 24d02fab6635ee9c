"""solution.h5 in h5py and xarray: named dimensions, coordinates, attributes, for every kind of problem.

usage: solution_in_xarray.py SEICHE CASES FOLDER; exit code 77 where the packages are missing
"""
import sys

try:
    import h5py
    import numpy as np
    import xarray as xr
except ImportError as missing:
    print(f"skipped: {missing}; Debian has python3-h5py and python3-xarray")
    sys.exit(77)

from short_run import check, run

engines = []
for engine, module in (("h5netcdf", "h5netcdf"), ("netcdf4", "netCDF4")):
    try:
        __import__(module)
        engines.append(engine)
    except ImportError:
        pass


def check_run(out, dimensions, shown=False):
    """`dimensions`: name → size, t first. `shown`: the fields lie in segments, and are virtual here."""
    names = list(dimensions)
    size = int(np.prod(list(dimensions.values())[1:]))
    with h5py.File(out / "solution.h5") as file:
        fields = file.attrs["fields"].split()
        for field in fields:
            data = file[field]
            check(data.shape == tuple(dimensions.values()), f"{out.name}: {field} has the shape {data.shape}")
            check(data.is_virtual == shown, f"{out.name}: {field} lies elsewhere")
            packed = data.compression == "gzip" and data.shuffle and data.chunks
            check(packed or shown, f"{out.name}: {field} is not compressed")
            check([axis[0].name[1:] for axis in data.dims] == names, f"{out.name}: axes of {field}")
            check(data.attrs["long_name"] and data.attrs["units"] == "1", f"{out.name}: attributes of {field}")
        check(h5py.h5ds.is_scale(file["t"].id) and np.array_equal(file["t"], np.arange(5) / 8), f"{out.name}: t")
        check("[problem]" in file.attrs["case"], f"{out.name}: the case")
        for name in ("equation", "method", "references", "versions", "status", "source"):
            check(file.attrs[name], f"{out.name}: attribute {name}")
        last = np.concatenate([file[field][-1].ravel() for field in fields])
        check(np.array_equal(last, np.loadtxt(out / "final.txt")), f"{out.name}: the last state is not final.txt")
        check(len(last) == size * len(fields), f"{out.name}: size")
    for engine in engines:
        with xr.open_dataset(out / "solution.h5", engine=engine) as data:
            check(dict(data.sizes) == dimensions, f"{out.name}, {engine}: {dict(data.sizes)}")
            check(set(names) == set(data.coords), f"{out.name}, {engine}: {list(data.coords)}")
            for field in fields:
                check(data[field].dims == tuple(names), f"{out.name}, {engine}: {data[field].dims}")
            energy = np.genfromtxt(out / "energy.csv", delimiter=",", names=True)
            both = np.intersect1d(energy["t"], data["t"].values)  # a run with a tolerance has states between its steps too
            written = energy["H"][np.isin(energy["t"], both)]
            check(len(both) >= 2 and np.array_equal(written, data["H"].sel(t=both)), f"{out.name}, {engine}: H")


check_run(run("klein_gordon", "problem.points=20"), {"t": 5, "x": 20})
check_run(run("klein_gordon_2d", "problem.points=[8,12]"), {"t": 5, "x": 8, "y": 11})
not_joined = ["problem.points=[128,130]", "output.join_below=0", "checkpoint.every_steps=6"]
check_run(run("klein_gordon_2d", *not_joined), {"t": 5, "x": 128, "y": 129}, shown=True)
check_run(
    run("sine_gordon", "problem.points=[4,6,8]", "problem.length=[4.0,6.0,8.0]"), {"t": 5, "x": 4, "y": 6, "z": 8}
)
check_run(run("alpha_fpu_conservative"), {"t": 5, "x": 19})
check_run(run("duffing"), {"t": 5})
check_run(run("network"), {"t": 5, "point": 10})
check_run(run("truss"), {"t": 5, "point": 14})
check_run(run("sparse"), {"t": 5, "point": 12})
check_run(run("rigid_body", "output.snapshot_interval=0.125"), {"t": 5})
print("read by h5py" + "".join(f" and xarray with {engine}" for engine in engines))
if not engines:
    print("xarray was not tried: neither h5netcdf nor netCDF4 is installed (python3-h5netcdf, python3-netcdf4)")
