# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""Surfaces of all labels of a volume by VTK's discrete flying edges, for `carpus bench imaging`.

vtk_surfaces.py FILE NX NY NZ SPACING_MM LABELS: FILE holds the labels 1 to LABELS as 16-bit numbers, x fastest. Prints
processor seconds of the filter (the least of three runs), its points and facets.
"""

import sys
import time

from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: F401  (the reader makes one)
from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D
from vtkmodules.vtkIOImage import vtkImageReader2


def main() -> None:
    file = sys.argv[1]
    nx, ny, nz = (int(word) for word in sys.argv[2:5])
    spacing = float(sys.argv[5])
    labels = int(sys.argv[6])
    reader = vtkImageReader2()
    reader.SetFileName(file)
    reader.SetFileDimensionality(3)
    reader.SetDataExtent(0, nx - 1, 0, ny - 1, 0, nz - 1)
    reader.SetDataSpacing(spacing, spacing, spacing)
    reader.SetDataScalarTypeToUnsignedShort()
    reader.SetDataByteOrderToLittleEndian()
    reader.Update()
    seconds = []
    for _ in range(3):
        edges = vtkDiscreteFlyingEdges3D()
        edges.SetInputConnection(reader.GetOutputPort())
        edges.ComputeNormalsOff()
        edges.ComputeGradientsOff()
        edges.ComputeScalarsOff()
        edges.GenerateValues(labels, 1, labels)
        start = time.process_time()
        edges.Update()
        seconds.append(time.process_time() - start)
        surface = edges.GetOutput()
    print(min(seconds), surface.GetNumberOfPoints(), surface.GetNumberOfPolys())


main()
