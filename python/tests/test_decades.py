"""Numbers along logarithmic axes."""

import matplotlib.pyplot as plt
import pytest
from seiche.drawing import curves


@pytest.mark.parametrize("low", [1e-5, 1.7e-5, 4e-5, 1.1e-4, 1.9e-4, 3e-4, 1e-3, 0.017, 6.0])
@pytest.mark.parametrize("decades", [0.35, 0.7, 1.0, 1.3, 1.6, 1.9, 2.5, 5, 12])
def test_numbers_of_a_logarithmic_axis_do_not_touch(low, decades):
    figure = plt.figure(figsize=(3, 2.4), layout="constrained")
    ax = figure.subplots()
    ax.loglog([low, low * 10**decades], [low, low * 10**decades])
    for axis in (ax.xaxis, ax.yaxis):
        curves.number_decades(axis)
    figure.canvas.draw()
    for axis, of in ((ax.xaxis, "x"), (ax.yaxis, "y")):
        begin, end = axis.get_view_interval()
        labels = [tick.label1 for tick in axis.get_major_ticks() if begin <= tick.get_loc() <= end]
        shown = [label.get_window_extent() for label in labels if label.get_text()]
        assert shown and all(getattr(a, of + "1") < getattr(b, of + "0") for a, b in zip(shown, shown[1:]))
        assert not any(tick.label1.get_text() for tick in axis.get_minor_ticks())
    plt.close(figure)
