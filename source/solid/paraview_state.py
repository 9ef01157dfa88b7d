# SPDX-License-Identifier: LGPL-2.1-or-later
# The block and its contact face over time, for ParaView 5.10 or newer.
#   paraview --state=paraview_state.py    to look at, or File > Load State
#   pvbatch paraview_state.py block.avi   a film
#   pvbatch paraview_state.py block.png   a picture of the end
# The deformation is drawn magnified. The contact face lies apart, coloured by r,
# the friction in parts of its strength.
import os
import sys

from paraview.simple import *

try:
    folder = os.path.dirname(os.path.abspath(__file__))
except NameError:
    folder = os.getcwd()
output = sys.argv[1] if len(sys.argv) > 1 else ""

block = PVDReader(FileName=os.path.join(folder, "fields.pvd"))
contact = PVDReader(FileName=os.path.join(folder, "contact.pvd"))
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
times = list(block.TimestepValues)
scene.AnimationTime = times[-1]
block.UpdatePipeline(times[-1])
contact.UpdatePipeline(times[-1])



def middles(what):
    bounds = what.GetDataInformation().GetBounds()
    return [(bounds[i] + bounds[i + 1]) / 2 for i in (0, 2, 4)]


bounds = block.GetDataInformation().GetBounds()
size = [bounds[i + 1] - bounds[i] for i in (0, 2, 4)]
is_flat = size[2] == 0
largest = max(block.PointData["deformation_mm"].GetRange(-1)[1], 1e-300)
factor = 0.1 * max(size) / largest

LoadPalette(paletteName="WhiteBackground")
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [1280, 720]
view.OrientationAxesVisibility = 1

warped = WarpByVector(Input=block, Vectors=["POINTS", "deformation_mm"],
                      ScaleFactor=factor)
shown = Show(warped, view)
shown.Representation = "Surface With Edges"
ColorBy(shown, ("POINTS", "deformation_mm", "Magnitude"))
shown.RescaleTransferFunctionToDataRange(False, True)
shown.SetScalarBarVisibility(view, True)
colours = GetColorTransferFunction("deformation_mm")
colours.ApplyPreset("Viridis (matplotlib)", True)
bar = GetScalarBar(colours, view)
bar.Title, bar.ComponentTitle = "deformation [mm]", "drawn x %.3g" % factor
bar.RangeLabelFormat = "%.3g"

# Away from the block, by half of its height.
normal = [b - a for a, b in zip(*(middles(what) for what in (block, contact)))]
face = Transform(Input=contact)
face.Transform.Translate = normal
face_shown = Show(face, view)
face_shown.Representation = "Surface"
if is_flat:
    face_shown.LineWidth = 6
ColorBy(face_shown, ("POINTS", "r"))
ratios = GetColorTransferFunction("r")
ratios.ApplyPreset("Cividis", True)
ratios.RescaleTransferFunction(0, max(1, contact.PointData["r"].GetRange()[1]))
face_shown.SetScalarBarVisibility(view, True)
ratio_bar = GetScalarBar(ratios, view)
ratio_bar.Title, ratio_bar.RangeLabelFormat = "r", "%.3g"

ResetCamera(view)
if not is_flat:
    view.CameraPosition = [middle + part * max(size) for middle, part in
                           zip(view.CameraFocalPoint, (-2, -3, 1.4))]
    view.CameraViewUp = [0, 0, 1]
    ResetCamera(view)
Show(AnnotateTimeFilter(Input=block, Format="{time:.4g} s"), view)
Render(view)
if output.endswith((".png", ".jpg")):
    SaveScreenshot(output, view)
elif output:
    SaveAnimation(output, view, FrameRate=10)
