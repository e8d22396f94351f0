#include "render/scene_view.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstdint>

namespace grainbench::render {
namespace {

constexpr const char* colour_array = "colour";
constexpr const char* radius_array = "radius";

vtkSmartPointer<vtkUnsignedCharArray> paint_of(const std::vector<Colour>& colours) {
    auto paint = vtkSmartPointer<vtkUnsignedCharArray>::New();
    paint->SetName(colour_array);
    paint->SetNumberOfComponents(3);
    paint->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
    for (std::size_t k = 0; k < colours.size(); ++k) {
        paint->SetTuple3(static_cast<vtkIdType>(k),
                         std::round(255.0 * colours[k].red),
                         std::round(255.0 * colours[k].green),
                         std::round(255.0 * colours[k].blue));
    }
    return paint;
}

vtkSmartPointer<vtkPoints> points_of(const std::vector<Vec3>& positions, const Vec3& shift) {
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
    for (std::size_t k = 0; k < positions.size(); ++k) {
        const Vec3 x = positions[k] + shift;
        points->SetPoint(static_cast<vtkIdType>(k), x.x, x.y, x.z);
    }
    return points;
}

void add_light(vtkRenderer* renderer, double x, double y, double z, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, z);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetIntensity(intensity);
    renderer->AddLight(light);
}

vtkSmartPointer<vtkPolyData> surface_of(const std::vector<WallSurface>& walls, const Vec3& shift) {
    std::vector<Vec3> points;
    vtkNew<vtkCellArray> polygons;
    for (const WallSurface& wall : walls) {
        const auto first = static_cast<vtkIdType>(points.size());
        points.insert(points.end(), wall.points.begin(), wall.points.end());
        for (const std::vector<Index>& polygon : wall.polygons) {
            polygons->InsertNextCell(static_cast<int>(polygon.size()));
            for (const Index corner : polygon) {
                polygons->InsertCellPoint(first + static_cast<vtkIdType>(corner));
            }
        }
    }
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(points_of(points, shift));
    surface->SetPolys(polygons);
    return surface;
}

/// The part of a surface, or of lines, inside a box: plane after plane, which is exact for flat
/// cells.
vtkSmartPointer<vtkPolyData> cut(vtkSmartPointer<vtkPolyData> data,
                                 const Box& box,
                                 const Vec3& shift) {
    const Vec3 low = box.low + shift;
    const Vec3 high = box.high + shift;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const Vec3& face = side < 0.0 ? low : high;
            vtkNew<vtkPlane> plane;
            plane->SetOrigin(face.x, face.y, face.z);
            plane->SetNormal(
                axis == 0 ? side : 0.0, axis == 1 ? side : 0.0, axis == 2 ? side : 0.0);
            vtkNew<vtkClipPolyData> knife;
            knife->SetInputData(data);
            knife->SetClipFunction(plane);
            knife->InsideOutOn();
            knife->Update();
            data = knife->GetOutput();
        }
    }
    return data;
}

/// Rims and sharp edges of a surface, as lines.
vtkSmartPointer<vtkPolyData> edges_of(vtkPolyData* surface) {
    constexpr double sharp = 40.0;  // degrees; facets of a round wall meet at less
    vtkNew<vtkFeatureEdges> edges;
    edges->SetInputData(surface);
    edges->BoundaryEdgesOn();
    edges->FeatureEdgesOn();
    edges->SetFeatureAngle(sharp);
    edges->NonManifoldEdgesOff();
    edges->ManifoldEdgesOff();
    edges->ColoringOff();
    edges->Update();
    return edges->GetOutput();
}

/// One side of a translucent surface.
void add_sheet(vtkRenderer* renderer,
               vtkPolyData* surface,
               const Colour& colour,
               double opacity,
               bool is_near_side) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty* property = actor->GetProperty();
    property->SetColor(colour.red, colour.green, colour.blue);
    property->SetOpacity(opacity);
    property->SetInterpolationToFlat();
    property->SetAmbient(0.6);  // like glass: hardly darker where it turns away
    property->SetDiffuse(0.4);
    property->SetBackfaceCulling(is_near_side);
    property->SetFrontfaceCulling(!is_near_side);
    renderer->AddActor(actor);
}

void add_lines(vtkRenderer* renderer, vtkPolyData* lines, const Colour& colour, double width) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(lines);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(colour.red, colour.green, colour.blue);
    actor->GetProperty()->SetLineWidth(static_cast<float>(width));
    actor->GetProperty()->LightingOff();
    renderer->AddActor(actor);
}

}  // namespace

void set_up(vtkRenderer* renderer, const Look& look, double mean_radius) {
    const Colour paper =
        look.background == Background::dark ? colour_of(0x15171C) : colour_of(0xFFFFFF);
    renderer->SetBackground(paper.red, paper.green, paper.blue);
    renderer->AutomaticLightCreationOff();
    // From over the left shoulder, with some light from the right so that no side is lost.
    add_light(renderer, -0.5, 0.8, 1.0, 0.85);
    add_light(renderer, 0.9, 0.1, 0.7, 0.3);
    renderer->SetAmbient(1.0, 1.0, 1.0);
    renderer->SetUseFXAA(look.anti_aliasing == AntiAliasing::fxaa);
    if (look.ambient_occlusion) {
        const double radius = look.ambient_occlusion->radius.value_or(4.0 * mean_radius);
        renderer->SetUseSSAO(true);
        renderer->SetSSAORadius(radius);
        renderer->SetSSAOBias(0.02 * radius);
        renderer->SetSSAOKernelSize(32);
        renderer->SetSSAOBlur(true);
    }
}

void add_spheres(vtkRenderer* renderer, const Spheres& spheres, const Vec3& shift) {
    if (spheres.position.empty()) {
        return;
    }
    vtkNew<vtkFloatArray> radius;
    radius->SetName(radius_array);
    vtkNew<vtkCellArray> vertices;  // without cells nothing is drawn
    for (std::size_t k = 0; k < spheres.radius.size(); ++k) {
        radius->InsertNextValue(static_cast<float>(spheres.radius[k]));
        vertices->InsertNextCell({static_cast<vtkIdType>(k)});
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points_of(spheres.position, shift));
    data->SetVerts(vertices);
    data->GetPointData()->AddArray(radius);
    data->GetPointData()->SetScalars(paint_of(spheres.colour));
    vtkNew<vtkOpenGLSphereMapper> mapper;
    mapper->SetInputData(data);
    mapper->SetScaleArray(radius_array);
    mapper->SetColorModeToDirectScalars();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty* property = actor->GetProperty();
    property->SetAmbient(0.22);
    property->SetDiffuse(0.85);
    property->SetSpecular(0.12);
    property->SetSpecularPower(30.0);
    renderer->AddActor(actor);
}

void add_walls(vtkRenderer* renderer,
               const std::vector<WallSurface>& walls,
               const WallLook& look,
               bool is_background_dark,
               double line_width,
               const Vec3& shift) {
    vtkSmartPointer<vtkPolyData> surface = surface_of(walls, shift);
    vtkSmartPointer<vtkPolyData> edges = edges_of(surface);
    if (look.region) {
        // Edges first, so that a cut does not look like a rim.
        edges = cut(edges, *look.region, shift);
        surface = cut(surface, *look.region, shift);
    }
    if (surface->GetNumberOfPolys() == 0) {
        return;
    }
    const Colour glass = is_background_dark ? colour_of(0xB0C4DE) : colour_of(0x5B7FA6);
    if (look.opacity > 0.0) {
        add_sheet(renderer, surface, glass, look.opacity, false);
        add_sheet(renderer, surface, glass, look.opacity, true);
    }
    if (look.edges) {
        const Colour line = is_background_dark ? colour_of(0x8090A0) : colour_of(0x708090);
        add_lines(renderer, edges, line, line_width);
    }
}

void add_traces(vtkRenderer* renderer,
                const io::TraceTable& traces,
                const std::vector<Colour>& colours,
                double radius,
                const Vec3& shift) {
    std::vector<Vec3> positions;
    vtkNew<vtkCellArray> lines;
    std::vector<vtkIdType> line;
    for (std::size_t k = 0; k < traces.points.size(); ++k) {
        positions.push_back(traces.points[k].position);
        line.push_back(static_cast<vtkIdType>(k));
        const bool is_last =
            k + 1 == traces.points.size() || traces.points[k + 1].id != traces.points[k].id;
        if (is_last) {
            if (line.size() > 1) {
                lines->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
            }
            line.clear();
        }
    }
    if (lines->GetNumberOfCells() == 0) {
        return;
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points_of(positions, shift));
    data->SetLines(lines);
    data->GetPointData()->SetScalars(paint_of(colours));
    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputData(data);
    tubes->SetRadius(radius);
    tubes->SetNumberOfSides(10);
    tubes->CappingOn();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(tubes->GetOutputPort());
    mapper->SetColorModeToDirectScalars();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetAmbient(0.3);
    actor->GetProperty()->SetDiffuse(0.75);
    renderer->AddActor(actor);
}

void set_camera(vtkRenderer* renderer, const CameraPose& pose, const Camera& camera) {
    vtkCamera* target = renderer->GetActiveCamera();
    target->SetPosition(pose.eye.x, pose.eye.y, pose.eye.z);
    target->SetFocalPoint(pose.focus.x, pose.focus.y, pose.focus.z);
    target->SetViewUp(pose.axes.up.x, pose.axes.up.y, pose.axes.up.z);
    target->SetParallelProjection(camera.projection == Projection::parallel);
    target->SetParallelScale(pose.half_height);
    target->SetViewAngle(camera.view_angle);
    target->SetWindowCenter(pose.centre_x, pose.centre_y);
    renderer->ResetCameraClippingRange();
}

}  // namespace grainbench::render
