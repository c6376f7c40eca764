#include "gui/views/scene3d/vtk_shapes.h"

#include <array>
#include <cmath>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

namespace kiln::gui {
namespace {

constexpr int kSegments = 20;  // round enough at the size of a wheel on the screen

/// A surface of revolution round Z from a profile of (radius, z), top to bottom.
vtkSmartPointer<vtkPolyData> revolve(const std::vector<Eigen::Vector2d>& profile) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  const auto rings = static_cast<vtkIdType>(profile.size());
  for (const Eigen::Vector2d& p : profile) {
    for (int i = 0; i < kSegments; ++i) {
      const double angle = 2.0 * M_PI * i / kSegments;
      points->InsertNextPoint(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
    }
  }
  for (vtkIdType ring = 0; ring + 1 < rings; ++ring) {
    for (vtkIdType i = 0; i < kSegments; ++i) {
      const vtkIdType next = (i + 1) % kSegments, a = ring * kSegments, b = a + kSegments;
      const std::array<vtkIdType, 4> quad{a + i, b + i, b + next, a + next};
      faces->InsertNextCell(4, quad.data());
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(faces);
  return mesh;
}

std::vector<Eigen::Vector2d> halfCircle(double radius, double z, double from, double to) {
  constexpr int kSteps = 6;
  std::vector<Eigen::Vector2d> out;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = from + (to - from) * i / kSteps;
    out.emplace_back(radius * std::cos(angle), z + radius * std::sin(angle));
  }
  return out;
}

std::array<Eigen::Vector3d, 8> corners(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  std::array<Eigen::Vector3d, 8> out;
  for (std::size_t i = 0; i < 8; ++i)
    out[i] = {(i & 1) ? high.x() : low.x(), (i & 2) ? high.y() : low.y(),
              (i & 4) ? high.z() : low.z()};
  return out;
}

/// Of a box, as indices into corners(), seen from outside counter-clockwise: low and high z, y, x.
constexpr std::array<std::array<vtkIdType, 4>, 6> kFaces{
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
constexpr std::array<double, 6> kShades{0.55, 1.0, 0.78, 0.78, 0.62, 0.62};  // of those faces

using Edges = std::vector<std::vector<Eigen::Vector3d>>;

void appendEdges(const Eigen::Isometry3d& X, const std::array<Eigen::Vector3d, 8>& c, Edges& out) {
  for (std::size_t i = 0; i < 8; ++i)
    for (const std::size_t bit : {1U, 2U, 4U})
      if ((i & bit) == 0) out.push_back({X * c[i], X * c[i | bit]});
}

}  // namespace

vtkSmartPointer<vtkPolyData> shadedBoxes(const std::vector<PlacedBox>& boxes, Rgb color) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> rgb;
  rgb->SetNumberOfComponents(3);
  vtkNew<vtkCellArray> cells;
  for (const PlacedBox& box : boxes) {
    const auto c = corners(-box.half_extent, box.half_extent);
    for (std::size_t f = 0; f < kFaces.size(); ++f) {
      cells->InsertNextCell(4);
      for (const vtkIdType corner : kFaces[f]) {
        const Eigen::Vector3d p = box.X * c[static_cast<std::size_t>(corner)];
        cells->InsertCellPoint(points->InsertNextPoint(p.data()));
        rgb->InsertNextTuple3(kShades[f] * color.r, kShades[f] * color.g, kShades[f] * color.b);
      }
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  mesh->GetPointData()->SetScalars(rgb);
  return mesh;
}

vtkSmartPointer<vtkPolyData> edgesOf(const std::vector<PlacedBox>& boxes) {
  Edges edges;
  for (const PlacedBox& box : boxes)
    appendEdges(box.X, corners(-box.half_extent, box.half_extent), edges);
  return lineMesh(edges);
}

vtkSmartPointer<vtkPolyData> boxMesh(const Eigen::Vector3d& size) {
  vtkNew<vtkPoints> points;
  for (const Eigen::Vector3d& p : corners(-0.5 * size, 0.5 * size))
    points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> faces;
  for (const auto& face : kFaces) faces->InsertNextCell(4, face.data());
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(faces);
  return mesh;
}

vtkSmartPointer<vtkPolyData> cylinderMesh(double radius, double length) {
  const double h = 0.5 * length;
  return revolve({{1e-6, h}, {radius, h}, {radius, -h}, {1e-6, -h}});
}

vtkSmartPointer<vtkPolyData> capsuleMesh(double radius, double length) {
  const double h = 0.5 * length;
  auto profile = halfCircle(radius, h, M_PI / 2 - 1e-3, 0.0);
  const auto bottom = halfCircle(radius, -h, 0.0, -M_PI / 2 + 1e-3);
  profile.insert(profile.end(), bottom.begin(), bottom.end());
  return revolve(profile);
}

vtkSmartPointer<vtkPolyData> sphereMesh(double radius) {
  return revolve(halfCircle(radius, 0.0, M_PI / 2 - 1e-3, -M_PI / 2 + 1e-3));
}

vtkSmartPointer<vtkPolyData> boxEdges(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Edges edges;
  appendEdges(Eigen::Isometry3d::Identity(), corners(low, high), edges);
  return lineMesh(edges);
}

vtkSmartPointer<vtkPolyData> lineMesh(const std::vector<std::vector<Eigen::Vector3d>>& lines) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& line : lines) {
    if (line.size() < 2) continue;
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const Eigen::Vector3d& p : line) cells->InsertCellPoint(points->InsertNextPoint(p.data()));
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetLines(cells);
  return mesh;
}

vtkSmartPointer<vtkPolyData> pointMesh(vtkFloatArray* xyz, vtkUnsignedCharArray* rgb) {
  const vtkIdType n = xyz->GetNumberOfTuples();
  vtkNew<vtkPoints> points;
  points->SetData(xyz);
  vtkNew<vtkIdTypeArray> offsets, ids;
  offsets->SetNumberOfValues(n + 1);
  ids->SetNumberOfValues(n);
  for (vtkIdType i = 0; i < n; ++i) ids->SetValue(i, i);
  for (vtkIdType i = 0; i <= n; ++i) offsets->SetValue(i, i);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, ids);
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetVerts(cells);
  mesh->GetPointData()->SetScalars(rgb);
  return mesh;
}

vtkSmartPointer<vtkActor> addActor(vtkRenderer& renderer, vtkPolyData* mesh) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  renderer.AddActor(actor);
  return actor;
}

void setMesh(vtkActor& actor, vtkPolyData* mesh) {
  vtkPolyDataMapper::SafeDownCast(actor.GetMapper())->SetInputData(mesh);
}

void setPose(vtkActor& actor, const Eigen::Isometry3d& X) {
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix->SetElement(row, column, X.matrix()(row, column));
  actor.SetUserMatrix(matrix);
}

void setColor(vtkActor& actor, Rgb color) {
  actor.GetProperty()->SetColor(color.r / 255.0, color.g / 255.0, color.b / 255.0);
}

void makeFlat(vtkActor& actor, float width) {
  actor.GetProperty()->LightingOff();
  actor.GetProperty()->SetLineWidth(width);
}

}  // namespace kiln::gui
