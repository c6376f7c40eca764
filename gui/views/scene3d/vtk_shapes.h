#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "gui/views/color/perceptual_map.h"

class vtkActor;
class vtkFloatArray;
class vtkUnsignedCharArray;
class vtkPolyData;
class vtkRenderer;
template <class T>
class vtkSmartPointer;

namespace kiln::gui {

/// Unit-free mesh makers and small setters shared by the layers of the scene; metres.
[[nodiscard]] vtkSmartPointer<vtkPolyData> boxMesh(const Eigen::Vector3d& size);
/// Along Z, centred.
[[nodiscard]] vtkSmartPointer<vtkPolyData> cylinderMesh(double radius, double length);
/// Along Z, centred; half spheres beyond the length.
[[nodiscard]] vtkSmartPointer<vtkPolyData> capsuleMesh(double radius, double length);
[[nodiscard]] vtkSmartPointer<vtkPolyData> sphereMesh(double radius);
/// A box somewhere: centre and axes, half of its size.
struct PlacedBox {
  Eigen::Isometry3d X;
  Eigen::Vector3d half_extent;
};
/// All of them in one mesh, outer faces counter-clockwise, coloured as if lit from above and one
/// side: for large solids that no lamp is to shade.
[[nodiscard]] vtkSmartPointer<vtkPolyData> shadedBoxes(const std::vector<PlacedBox>& boxes,
                                                       Rgb color);
[[nodiscard]] vtkSmartPointer<vtkPolyData> edgesOf(const std::vector<PlacedBox>& boxes);
/// The twelve edges of a box given by two corners.
[[nodiscard]] vtkSmartPointer<vtkPolyData> boxEdges(const Eigen::Vector3d& low,
                                                    const Eigen::Vector3d& high);
/// One polyline for each list; lists of fewer than two points are left out.
[[nodiscard]] vtkSmartPointer<vtkPolyData> lineMesh(
    const std::vector<std::vector<Eigen::Vector3d>>& lines);

/// Coloured points; arrays of three components and equal length.
[[nodiscard]] vtkSmartPointer<vtkPolyData> pointMesh(vtkFloatArray* xyz, vtkUnsignedCharArray* rgb);

[[nodiscard]] vtkSmartPointer<vtkActor> addActor(vtkRenderer& renderer, vtkPolyData* mesh);
void setMesh(vtkActor& actor, vtkPolyData* mesh);
void setPose(vtkActor& actor, const Eigen::Isometry3d& X);
void setColor(vtkActor& actor, Rgb color);
/// A line or a wire that no lamp shades.
void makeFlat(vtkActor& actor, float width);

}  // namespace kiln::gui
