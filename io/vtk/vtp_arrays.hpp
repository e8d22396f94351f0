/// Arrays of a VTK XML file that anybody may have made. VTK's own reader believes such a file: on
/// hostile ones version 9.1 divides by zero, looks behind the end of arrays, forgets memory and
/// asks for any amount of it (all found by tests/fuzz). Here VTK parses the XML and unpacks blocks,
/// and every size is held against the bytes that are there. Private to io: this header shows VTK.
#pragma once

#include <vtkSmartPointer.h>

#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

class vtkDataCompressor;
class vtkXMLDataElement;
class vtkXMLDataParser;

namespace grainbench::io {

/// All functions throw std::runtime_error, which says what is wrong with the file.
class VtpArrays {
public:
    /// \param bytes of the whole file; they must outlive this
    explicit VtpArrays(const std::string& bytes);

    /// The element PolyData.
    vtkXMLDataElement* data() const { return data_; }

    /// Numbers of an element DataArray, all its components one after the other.
    std::vector<double> numbers(vtkXMLDataElement* array) const;

    /// Texts of an element Array.
    std::vector<std::string> texts(vtkXMLDataElement* array) const;

private:
    std::string_view text_of(vtkXMLDataElement* array) const;
    std::string unpacked(vtkXMLDataElement* array) const;
    std::string decompressed(std::string_view data, bool is_base64) const;
    std::size_t word(std::string_view header, std::size_t number) const;

    const std::string& bytes_;
    std::istringstream stream_;
    vtkSmartPointer<vtkXMLDataParser> parser_;
    vtkXMLDataElement* data_ = nullptr;
    vtkSmartPointer<vtkDataCompressor> compressor_;  ///< null = not compressed
    std::size_t word_size_ = 4;                      ///< bytes of a number in a header
    bool is_swapped_ = false;                        ///< bytes stand in the other order
};

/// The attribute of an element; `otherwise` if it has none.
std::string_view attribute(vtkXMLDataElement* element,
                           const char* name,
                           std::string_view otherwise = "");

/// The attribute as a number that is not negative.
std::size_t count_attribute(vtkXMLDataElement* element, const char* name, std::size_t otherwise);

}  // namespace grainbench::io
