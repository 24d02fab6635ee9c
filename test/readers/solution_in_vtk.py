"""solution.xdmf in VTK's reader, which is ParaView's: times, places and values of every point.

usage: solution_in_vtk.py SEICHE CASES FOLDER; exit code 77 where VTK or its reader is missing
"""
import sys

try:
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
except ImportError as missing:
    print(f"skipped: {missing}; Debian has it in python3-paraview")
    sys.exit(77)

from short_run import check, run



def places(file):
    """Of the points in the order of the file; the mesh where there is one."""
    if "mesh" in file:
        return file["mesh"].get("points", file["mesh"].get("numbers"))[:].reshape(-1, 3)
    if "x" in file and h5py.h5ds.is_scale(file["x"].id):
        axes = [file["x"][:]]
    else:
        axes = [np.zeros(1)]
    return np.column_stack(axes + [np.zeros_like(axes[0])] * (3 - len(axes)))


def check_run(out, kind, all_times=True):
    reader = vtkXdmfReader()
    reader.SetFileName(str(out / "solution.xdmf"))
    reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    key = reader.GetExecutive().TIME_STEPS()
    times = [information.Get(key, i) for i in range(information.Length(key))]
    with h5py.File(out / "solution.h5") as file:
        t = file["t"][:]
        rows = [int(np.argmin(abs(t - time))) for time in times]
        check(np.allclose(times, t[rows]) and rows[0] == 0 and rows[-1] == len(t) - 1, f"{out.name}: times {times}")
        check((len(times) == len(t)) == all_times, f"{out.name}: {len(times)} of {len(t)} times")
        for time, step in ((times[i], rows[i]) for i in (0, len(times) // 2, -1)):
            reader.UpdateTimeStep(time)
            data = reader.GetOutputDataObject(0)
            check(data.GetClassName() == kind, f"{out.name}: {data.GetClassName()} instead of {kind}")
            points = np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])
            check(points.shape == places(file).shape, f"{out.name}: {len(points)} points, not {len(places(file))}")
            check(np.allclose(points, places(file)), f"{out.name}: places of points {points[:3]} {places(file)[:3]}")
            for field in file.attrs["fields"].split():
                array = data.GetPointData().GetArray(field)
                check(array is not None, f"{out.name}: no {field}")
                values = vtk_to_numpy(array).ravel()
                check(np.array_equal(values, file[field][step].ravel()), f"{out.name}: values of {field} at step {step}")


check_run(run("klein_gordon", "problem.points=20"), "vtkImageData")
check_run(run("klein_gordon_2d", "problem.points=[8,12]"), "vtkStructuredGrid")
check_run(run("sine_gordon", "problem.points=[4,6,8]", "problem.length=[4.0,6.0,8.0]"), "vtkStructuredGrid")
check_run(run("duffing"), "vtkUnstructuredGrid")
check_run(run("duffing", "time.end=40", "output.snapshot_every=1"), "vtkUnstructuredGrid", all_times=False)
check_run(run("network"), "vtkUnstructuredGrid")
check_run(run("truss"), "vtkUnstructuredGrid")
print("VTK reads what was written")
