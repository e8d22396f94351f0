#include "io/vtk/pvd.hpp"

#include "io/atomic_file.hpp"
#include "io/text.hpp"
#include "io/vtk/load.hpp"

#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <sstream>

namespace grainbench::io {
namespace {

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

}  // namespace

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) {
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "  <Collection>\n";
    for (const PvdEntry& entry : entries) {
        text += "    <DataSet timestep=\"" + to_text(entry.time) +
                "\" group=\"\" part=\"0\" file=\"" + escaped(entry.file) + "\"/>\n";
    }
    text += "  </Collection>\n</VTKFile>\n";
    write_file(path, text);
}

std::vector<PvdEntry> read_pvd(const std::filesystem::path& path) {
    std::istringstream stream(read_file(path));
    const VtkSession session;
    vtkNew<vtkXMLDataParser> parser;
    parser->SetStream(&stream);
    const bool is_parsed = parser->Parse() != 0 && session.error().empty();
    vtkXMLDataElement* root = is_parsed ? parser->GetRootElement() : nullptr;
    vtkXMLDataElement* collection =
        root == nullptr ? nullptr : root->FindNestedElementWithName("Collection");
    if (collection == nullptr) {
        throw_damaged(path, session.error().empty() ? "it holds no Collection" : session.error());
    }
    std::vector<PvdEntry> entries;
    for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
        vtkXMLDataElement* element = collection->GetNestedElement(k);
        const char* file = element->GetAttribute("file");
        PvdEntry entry;
        if (file == nullptr || element->GetScalarAttribute("timestep", entry.time) == 0) {
            throw_damaged(path, "an entry lacks its time or its file");
        }
        entry.file = file;
        entries.push_back(std::move(entry));
    }
    return entries;
}

}  // namespace grainbench::io
