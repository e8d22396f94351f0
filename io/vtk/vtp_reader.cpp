#include "io/vtk/vtp_reader.hpp"

#include "io/vtk/arrays.hpp"
#include "io/vtk/vtp_arrays.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLDataElement.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace grainbench::io {
namespace {

/// Nested elements, all or those of one name.
std::vector<vtkXMLDataElement*> children(vtkXMLDataElement* element, std::string_view name = "") {
    std::vector<vtkXMLDataElement*> found;
    for (int k = 0; element != nullptr && k < element->GetNumberOfNestedElements(); ++k) {
        vtkXMLDataElement* child = element->GetNestedElement(k);
        if (name.empty() || name == child->GetName()) {
            found.push_back(child);
        }
    }
    return found;
}

vtkXMLDataElement* child_with(vtkXMLDataElement* parent, std::string_view array) {
    for (vtkXMLDataElement* child : children(parent)) {
        if (attribute(child, "Name") == array) {
            return child;
        }
    }
    return nullptr;
}

bool holds_text(vtkXMLDataElement* array) {
    return attribute(array, "type") == "String";
}

vtkSmartPointer<vtkStringArray> text_array(const char* name,
                                           const std::vector<std::string>& texts) {
    auto array = vtkSmartPointer<vtkStringArray>::New();
    array->SetName(name);
    for (const std::string& text : texts) {
        array->InsertNextValue(text);
    }
    return array;
}

/// Integers within [0, end).
template <class T>
std::vector<T> integers(const std::vector<double>& numbers, double end, const char* what) {
    std::vector<T> found;
    for (const double number : numbers) {
        if (!(number >= 0.0 && number < end)) {
            throw std::runtime_error(what);
        }
        found.push_back(static_cast<T>(number));
    }
    return found;
}

/// Arrays of the points of all pieces.
class Points {
public:
    void add(const VtpArrays& file, vtkXMLDataElement* piece, std::size_t count) {
        const std::vector<vtkXMLDataElement*> arrays =
            children(piece->FindNestedElementWithName("Points"));
        if (count == 0) {
            return;
        }
        if (arrays.empty()) {
            throw std::runtime_error("it has points without positions");
        }
        append(positions_, file.numbers(arrays.front()), count, 3);
        vtkXMLDataElement* data = piece->FindNestedElementWithName("PointData");
        for (Numbers& one : numbers_) {
            if (vtkXMLDataElement* array = child_with(data, one.name)) {
                append(one.values, file.numbers(array), count, one.components);
            }
        }
        if (vtkXMLDataElement* array = child_with(data, "species")) {
            if (holds_text(array)) {
                for (std::string& name : file.texts(array)) {
                    species_names_.push_back(std::move(name));
                }
            } else {
                append(species_, file.numbers(array), count, 1);
            }
        }
    }

    void hand_over(vtkPolyData* data) const {
        const std::size_t count = positions_.size() / 3;
        vtkNew<vtkPoints> points;
        points->SetData(array_of({"position", 3, positions_}));
        data->SetPoints(points);
        vtkPointData* arrays = data->GetPointData();
        for (const Numbers& one : numbers_) {
            if (!one.values.empty()) {
                arrays->AddArray(array_of(one));
            }
        }
        if (!species_names_.empty()) {
            if (species_names_.size() != count) {
                throw std::runtime_error("the array 'species' has an unexpected size");
            }
            arrays->AddArray(text_array("species", species_names_));
        } else if (!species_.empty()) {
            const auto numbers = integers<std::int32_t>(species_,
                                                        std::numeric_limits<std::int32_t>::max(),
                                                        "a number of a species is out of range");
            arrays->AddArray(int32_array("species", numbers));
        }
    }

private:
    struct Numbers {
        const char* name;
        std::size_t components;
        std::vector<double> values{};
    };

    static void append(std::vector<double>& all,
                       const std::vector<double>& more,
                       std::size_t count,
                       std::size_t components) {
        if (more.size() % components != 0 || more.size() / components != count) {
            throw std::runtime_error("an array of points has an unexpected size");
        }
        all.insert(all.end(), more.begin(), more.end());
    }

    static vtkSmartPointer<vtkDoubleArray> array_of(const Numbers& numbers) {
        auto array = vtkSmartPointer<vtkDoubleArray>::New();
        array->SetName(numbers.name);
        array->SetNumberOfComponents(static_cast<int>(numbers.components));
        array->SetNumberOfValues(static_cast<vtkIdType>(numbers.values.size()));
        std::copy(numbers.values.begin(), numbers.values.end(), array->Begin());
        return array;
    }

    std::vector<double> positions_;
    std::vector<Numbers> numbers_{{"radius", 1}, {"velocity", 3}, {"angular_velocity", 3}};
    std::vector<double> species_;
    std::vector<std::string> species_names_;
};

/// Adds the polygons or strips of one piece.
/// \param first, count points of the piece among those of all pieces
void add_cells(const VtpArrays& file,
               vtkXMLDataElement* element,
               std::size_t first,
               std::size_t count,
               vtkCellArray* cells) {
    vtkXMLDataElement* corners = child_with(element, "connectivity");
    vtkXMLDataElement* ends = child_with(element, "offsets");
    if (corners == nullptr || ends == nullptr) {
        return;
    }
    std::vector<vtkIdType> points =
        integers<vtkIdType>(file.numbers(corners),
                            static_cast<double>(count),
                            "a polygon has a corner that is no point of the file");
    for (vtkIdType& point : points) {
        point += static_cast<vtkIdType>(first);
    }
    std::size_t begin = 0;
    for (const std::size_t end :
         integers<std::size_t>(file.numbers(ends),
                               static_cast<double>(points.size()) + 1.0,
                               "a polygon has more corners than there are")) {
        if (end < begin + 3) {
            throw std::runtime_error("a polygon has fewer than three corners");
        }
        cells->InsertNextCell(static_cast<vtkIdType>(end - begin), points.data() + begin);
        begin = end;
    }
}

}  // namespace

vtkSmartPointer<vtkPolyData> polygons_of_vtp(const std::string& bytes) {
    const VtpArrays file(bytes);
    Points points;
    vtkNew<vtkCellArray> polygons;
    vtkNew<vtkCellArray> strips;
    std::size_t first = 0;
    for (vtkXMLDataElement* piece : children(file.data(), "Piece")) {
        const std::size_t count = count_attribute(piece, "NumberOfPoints", 0);
        points.add(file, piece, count);
        add_cells(file, piece->FindNestedElementWithName("Polys"), first, count, polygons);
        add_cells(file, piece->FindNestedElementWithName("Strips"), first, count, strips);
        first += count;
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    points.hand_over(data);
    data->SetPolys(polygons);
    data->SetStrips(strips);
    if (vtkXMLDataElement* names =
            child_with(file.data()->FindNestedElementWithName("FieldData"), "species_names")) {
        if (holds_text(names)) {
            data->GetFieldData()->AddArray(text_array("species_names", file.texts(names)));
        }
    }
    return data;
}

}  // namespace grainbench::io
