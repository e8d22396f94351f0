#include "io/vtk/vtp_arrays.hpp"

#include <vtkBase64Utilities.h>
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace grainbench::io {
namespace {

/// Times that a block may grow when it is unpacked: zlib reaches 1032, LZMA some thousands. More is
/// a lie about sizes.
constexpr std::size_t most_expansion = 10'000;

[[noreturn]] void fail(const std::string& reason) {
    throw std::runtime_error(reason);
}

vtkSmartPointer<vtkDataCompressor> compressor_named(std::string_view name) {
    if (name == "vtkZLibDataCompressor") {
        return vtkSmartPointer<vtkZLibDataCompressor>::New();
    }
    if (name == "vtkLZ4DataCompressor") {
        return vtkSmartPointer<vtkLZ4DataCompressor>::New();
    }
    if (name == "vtkLZMADataCompressor") {
        return vtkSmartPointer<vtkLZMADataCompressor>::New();
    }
    if (!name.empty()) {
        fail("the compression '" + std::string(name) + "' is unknown");
    }
    return nullptr;
}

const unsigned char* unsigned_bytes(std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
}

unsigned char* unsigned_bytes(std::string& text) {
    return reinterpret_cast<unsigned char*>(text.data());
}

/// Characters that so many bytes take up.
std::size_t encoded_size(std::size_t count, bool is_base64) {
    return is_base64 ? (count + 2) / 3 * 4 : count;
}

/// The first bytes of encoded data.
std::string decoded(std::string_view data, bool is_base64, std::size_t count) {
    // The first test keeps the sum in encoded_size() from running over.
    if (count > data.size() || encoded_size(count, is_base64) > data.size()) {
        fail("an array ends too early");
    }
    if (!is_base64) {
        return std::string(data.substr(0, count));
    }
    const std::size_t characters = encoded_size(count, is_base64);
    std::string bytes(characters / 4 * 3, '\0');
    if (vtkBase64Utilities::DecodeSafely(
            unsigned_bytes(data), characters, unsigned_bytes(bytes), bytes.size()) < count) {
        fail("an array is no base64 text");
    }
    bytes.resize(count);
    return bytes;
}

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

std::vector<double> numbers_of_text(std::string_view text) {
    std::vector<double> numbers;
    const char* const end = text.data() + text.size();
    for (const char* at = text.data();;) {
        at = std::find_if_not(at, end, is_space);
        if (at == end) {
            return numbers;
        }
        double number = 0.0;
        const auto [next, error] = std::from_chars(at + (*at == '+' ? 1 : 0), end, number);
        if (error != std::errc{} || (next != end && !is_space(*next))) {
            fail("an array holds something that is no number");
        }
        numbers.push_back(number);
        at = next;
    }
}

template <class T>
std::vector<double> numbers_of_bytes(std::string_view bytes, bool is_swapped) {
    if (bytes.size() % sizeof(T) != 0) {
        fail("an array ends within a number");
    }
    std::vector<double> numbers(bytes.size() / sizeof(T));
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        std::array<char, sizeof(T)> word{};
        std::copy_n(bytes.data() + k * sizeof(T), sizeof(T), word.data());
        if (is_swapped) {
            std::reverse(word.begin(), word.end());
        }
        numbers[k] = static_cast<double>(std::bit_cast<T>(word));
    }
    return numbers;
}

using Conversion = std::vector<double> (*)(std::string_view, bool);

Conversion conversion_of(std::string_view type) {
    constexpr std::array<std::pair<std::string_view, Conversion>, 10> types{
        {{"Int8", numbers_of_bytes<std::int8_t>},
         {"UInt8", numbers_of_bytes<std::uint8_t>},
         {"Int16", numbers_of_bytes<std::int16_t>},
         {"UInt16", numbers_of_bytes<std::uint16_t>},
         {"Int32", numbers_of_bytes<std::int32_t>},
         {"UInt32", numbers_of_bytes<std::uint32_t>},
         {"Int64", numbers_of_bytes<std::int64_t>},
         {"UInt64", numbers_of_bytes<std::uint64_t>},
         {"Float32", numbers_of_bytes<float>},
         {"Float64", numbers_of_bytes<double>}}};
    for (const auto& [name, conversion] : types) {
        if (name == type) {
            return conversion;
        }
    }
    fail("an array has the unknown type '" + std::string(type) + "'");
}

}  // namespace

std::string_view attribute(vtkXMLDataElement* element,
                           const char* name,
                           std::string_view otherwise) {
    const char* value = element->GetAttribute(name);
    return value == nullptr ? otherwise : value;
}

std::size_t count_attribute(vtkXMLDataElement* element, const char* name, std::size_t otherwise) {
    const std::string_view text = attribute(element, name);
    std::size_t count = otherwise;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (!text.empty() && (error != std::errc{} || end != text.data() + text.size())) {
        fail("the attribute '" + std::string(name) + "' is no count");
    }
    return count;
}

VtpArrays::VtpArrays(const std::string& bytes)
    : bytes_(bytes), stream_(bytes), parser_(vtkSmartPointer<vtkXMLDataParser>::New()) {
    parser_->SetStream(&stream_);
    if (parser_->Parse() == 0 || parser_->GetRootElement() == nullptr) {
        fail("its XML cannot be parsed");
    }
    vtkXMLDataElement* root = parser_->GetRootElement();
    data_ = root->FindNestedElementWithName("PolyData");
    if (data_ == nullptr) {
        fail("it holds no PolyData");
    }
    compressor_ = compressor_named(attribute(root, "compressor"));
    word_size_ = attribute(root, "header_type") == "UInt64" ? 8 : 4;
    const bool is_big = attribute(root, "byte_order") == "BigEndian";
    is_swapped_ = is_big != (std::endian::native == std::endian::big);
}

std::vector<double> VtpArrays::numbers(vtkXMLDataElement* array) const {
    if (attribute(array, "format", "ascii") == "ascii") {
        return numbers_of_text(text_of(array));
    }
    return conversion_of(attribute(array, "type"))(unpacked(array), is_swapped_);
}

std::vector<std::string> VtpArrays::texts(vtkXMLDataElement* array) const {
    std::string characters;
    if (attribute(array, "format", "ascii") == "ascii") {
        for (const double code : numbers_of_text(text_of(array))) {
            if (!(code > -129.0 && code < 256.0)) {
                fail("a text holds something that is no character");
            }
            characters += static_cast<char>(static_cast<int>(code));
        }
    } else {
        characters = unpacked(array);
    }
    std::vector<std::string> texts;
    for (std::size_t at = 0, end = 0; at < characters.size(); at = end + 1) {
        end = std::min(characters.find('\0', at), characters.size());
        texts.push_back(characters.substr(at, end - at));
    }
    return texts;
}

std::string_view VtpArrays::text_of(vtkXMLDataElement* array) const {
    const std::string_view all = bytes_;
    const std::size_t begin = all.find('>', static_cast<std::size_t>(array->GetXMLByteIndex()));
    if (begin == std::string_view::npos || begin == 0 || all[begin - 1] == '/') {
        return {};
    }
    return all.substr(begin + 1, all.find('<', begin) - begin - 1);
}

/// Uncompressed data are their length and the bytes; decompressed() says what others are.
std::string VtpArrays::unpacked(vtkXMLDataElement* array) const {
    bool is_base64 = true;
    std::string text;  // without blanks
    std::string_view data;
    if (attribute(array, "format") == "appended") {
        vtkXMLDataElement* appended =
            parser_->GetRootElement()->FindNestedElementWithName("AppendedData");
        const auto start = static_cast<std::size_t>(parser_->GetAppendedDataPosition());
        const std::size_t offset = count_attribute(array, "offset", 0);
        if (appended == nullptr || start > bytes_.size() || offset > bytes_.size() - start) {
            fail("an array begins behind the end of the file");
        }
        is_base64 = attribute(appended, "encoding", "base64") == "base64";
        data = std::string_view(bytes_).substr(start + offset);
    } else {
        std::ranges::remove_copy_if(text_of(array), std::back_inserter(text), is_space);
        data = text;
    }
    if (compressor_ != nullptr) {
        return decompressed(data, is_base64);
    }
    const std::size_t size = word(decoded(data, is_base64, word_size_), 0);
    if (size > data.size()) {
        fail("an array ends too early");
    }
    return decoded(data, is_base64, word_size_ + size).substr(word_size_);
}

/// A header, which is encoded by itself: number of blocks, size of a block, size of the last one or
/// 0 if it is as large as the others, and their compressed sizes. Then the blocks.
std::string VtpArrays::decompressed(std::string_view data, bool is_base64) const {
    const std::size_t count = word(decoded(data, is_base64, word_size_), 0);
    if (count > data.size() / word_size_) {
        fail("an array has more blocks than the file could hold");
    }
    const std::size_t header_size = (3 + count) * word_size_;
    const std::string header = decoded(data, is_base64, header_size);
    data.remove_prefix(encoded_size(header_size, is_base64));
    std::size_t packed_size = 0;
    for (std::size_t k = 0; k < count; ++k) {
        packed_size += std::min(word(header, 3 + k), data.size() + 1);
        packed_size = std::min(packed_size, data.size() + 1);  // so that no sum runs over
    }
    const std::string packed = decoded(data, is_base64, packed_size);
    std::string bytes;
    std::size_t begin = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t from = word(header, 3 + k);
        const std::size_t last = word(header, 2);
        const std::size_t to = k + 1 == count && last != 0 ? last : word(header, 1);
        if (to / most_expansion > from) {
            fail("a block is said to be far larger than it can be");
        }
        const std::size_t before = bytes.size();
        bytes.resize(before + to);
        if (to > 0 &&
            compressor_->Uncompress(
                unsigned_bytes(packed) + begin, from, unsigned_bytes(bytes) + before, to) != to) {
            fail("a block cannot be decompressed");
        }
        begin += from;
    }
    return bytes;
}

std::size_t VtpArrays::word(std::string_view header, std::size_t number) const {
    const std::string_view bytes = header.substr(number * word_size_, word_size_);
    std::array<unsigned char, 8> low_first{};
    std::copy(bytes.begin(), bytes.end(), low_first.begin());
    const bool is_big = (std::endian::native == std::endian::big) != is_swapped_;
    if (is_big) {
        std::reverse(low_first.begin(), low_first.begin() + word_size_);
    }
    std::size_t value = 0;
    for (std::size_t k = 0; k < word_size_; ++k) {
        value |= std::size_t{low_first[k]} << (8 * k);
    }
    return value;
}

}  // namespace grainbench::io
