#include "io/hdf5/handle.hpp"

#include <array>

namespace grainbench::io {
namespace {

/// The library is built without threads on some systems and may not be entered twice.
std::mutex& hdf5_mutex() {
    static std::mutex mutex;
    return mutex;
}

constexpr std::size_t image_growth = std::size_t{1} << 20;  // [bytes] by which images grow

Handle memory_access() {
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make an access list");
    must(H5Pset_fapl_core(access.id(), image_growth, 0), "choose memory files");
    return access;
}

/// Properties of whatever is created: members in order, and no clock, so that equal content gives
/// equal bytes.
template <class Class>
Handle creation(Class list_class) {
    Handle list(H5Pcreate(list_class), H5Pclose, "make a creation list");
    must(H5Pset_obj_track_times(list.id(), false), "switch off time stamps");
    return list;
}

void keep_order(const Handle& list) {
    must(H5Pset_link_creation_order(list.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
         "keep the order of members");
}

Handle scalar_space() {
    return {H5Screate(H5S_SCALAR), H5Sclose, "make a scalar"};
}

Handle text_type() {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
    must(H5Tset_size(type.id(), H5T_VARIABLE), "make a text type");
    must(H5Tset_cset(type.id(), H5T_CSET_UTF8), "make a text type");
    return type;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
    static_cast<std::vector<std::string>*>(names)->push_back(decode_link(name));
    return 0;
}

}  // namespace

Hdf5Session::Hdf5Session() : lock_(hdf5_mutex()) {
    H5Eget_auto2(H5E_DEFAULT, &print_before_, &data_before_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Session::~Hdf5Session() {
    H5Eset_auto2(H5E_DEFAULT, print_before_, data_before_);
}

Handle create_file_image() {
    const Handle access = memory_access();
    const Handle list = creation(H5P_FILE_CREATE);
    keep_order(list);
    return {H5Fcreate("image", H5F_ACC_TRUNC, list.id(), access.id()), H5Fclose, "make a file"};
}

std::string_view bytes_of(const Handle& file) {
    must(H5Fflush(file.id(), H5F_SCOPE_GLOBAL), "complete the file");
    const ssize_t size = must(H5Fget_file_image(file.id(), nullptr, 0), "measure the file");
    void* place = nullptr;  // of the memory driver: the pointer to its buffer
    must(H5Fget_vfd_handle(file.id(), H5P_DEFAULT, &place), "find the bytes of the file");
    return {*static_cast<char**>(place), static_cast<std::size_t>(size)};
}

Handle open_file_image(std::string& bytes) {
    const Handle access = memory_access();
    must(H5Pset_file_image(access.id(), bytes.data(), bytes.size()), "take the bytes of the file");
    return {H5Fopen("image", H5F_ACC_RDONLY, access.id()), H5Fclose, "find HDF5 in the file"};
}

Handle create_group(const Handle& parent, const std::string& name) {
    const Handle list = creation(H5P_GROUP_CREATE);
    keep_order(list);
    return {H5Gcreate2(parent.id(), encode_link(name).c_str(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
            H5Gclose,
            "make the group '" + name + "'"};
}

Handle open_group(const Handle& parent, const std::string& name) {
    return {H5Gopen2(parent.id(), encode_link(name).c_str(), H5P_DEFAULT),
            H5Gclose,
            "open the group '" + name + "'"};
}

std::vector<std::string> members_of(const Handle& group) {
    std::vector<std::string> names;
    hsize_t position = 0;
    must(H5Literate(group.id(), H5_INDEX_CRT_ORDER, H5_ITER_INC, &position, collect_name, &names),
         "list the members of a group");
    return names;
}

bool has_member(const Handle& group, const std::string& name) {
    return must(H5Lexists(group.id(), encode_link(name).c_str(), H5P_DEFAULT),
                "look for a member") > 0;
}

std::string encode_link(std::string_view name) {
    if (name.empty() || name == ".") {
        return name.empty() ? "%" : "%2E";
    }
    std::string link;
    for (const char c : name) {
        if (c == '/') {
            link += "%2F";
        } else if (c == '%') {
            link += "%25";
        } else {
            link += c;
        }
    }
    return link;
}

std::string decode_link(std::string_view link) {
    std::string name;
    for (std::size_t k = 0; k < link.size(); ++k) {
        if (link[k] != '%') {
            name += link[k];
            continue;
        }
        const std::string_view code = link.substr(k + 1, 2);
        if (!code.empty()) {
            name += code == "2F" ? '/' : code == "2E" ? '.' : '%';
        }
        k += code.size();
    }
    return name;
}

void put_attribute(const Handle& object, const char* name, const std::string& text) {
    const Handle type = text_type();
    const Handle space = scalar_space();
    const Handle attribute(
        H5Acreate2(object.id(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose,
        "make the attribute '" + std::string(name) + "'");
    const char* start = text.c_str();
    must(H5Awrite(attribute.id(), type.id(), static_cast<const void*>(&start)),
         "write the attribute '" + std::string(name) + "'");
}

void put_attribute(const Handle& object, const char* name, std::int64_t value) {
    const Handle space = scalar_space();
    const Handle attribute(
        H5Acreate2(object.id(), name, H5T_STD_I64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose,
        "make the attribute '" + std::string(name) + "'");
    must(H5Awrite(attribute.id(), H5T_NATIVE_INT64, &value),
         "write the attribute '" + std::string(name) + "'");
}

std::string text_attribute(const Handle& object, const char* name) {
    const std::string action = "read the text attribute '" + std::string(name) + "'";
    const Handle attribute(H5Aopen(object.id(), name, H5P_DEFAULT), H5Aclose, action);
    const Handle found(H5Aget_type(attribute.id()), H5Tclose, action);
    const Handle space(H5Aget_space(attribute.id()), H5Sclose, action);
    if (H5Tis_variable_str(found.id()) <= 0 || H5Sget_simple_extent_npoints(space.id()) != 1) {
        throw Hdf5Failure("cannot " + action);
    }
    const Handle type = text_type();
    char* start = nullptr;
    must(H5Aread(attribute.id(), type.id(), static_cast<void*>(&start)), action);
    std::string text = start == nullptr ? "" : start;
    H5free_memory(start);
    return text;
}

std::int64_t integer_attribute(const Handle& object, const char* name) {
    const std::string action = "read the attribute '" + std::string(name) + "'";
    const Handle attribute(H5Aopen(object.id(), name, H5P_DEFAULT), H5Aclose, action);
    const Handle space(H5Aget_space(attribute.id()), H5Sclose, action);
    if (H5Sget_simple_extent_npoints(space.id()) != 1) {
        throw Hdf5Failure("cannot " + action);
    }
    std::int64_t value = 0;
    must(H5Aread(attribute.id(), H5T_NATIVE_INT64, &value), action);
    return value;
}

template <>
hid_t stored_type<double>() {
    return H5T_IEEE_F64LE;
}

template <>
hid_t stored_type<std::int64_t>() {
    return H5T_STD_I64LE;
}

template <>
hid_t stored_type<std::uint64_t>() {
    return H5T_STD_U64LE;
}

template <>
hid_t stored_type<std::uint32_t>() {
    return H5T_STD_U32LE;
}

template <>
hid_t stored_type<std::uint8_t>() {
    return H5T_STD_U8LE;
}

Handle put_dataset(const Handle& group,
                   const std::string& name,
                   hid_t type,
                   const void* data,
                   std::size_t rows,
                   std::size_t width) {
    const std::string action = "write the data set '" + name + "'";
    const std::array<hsize_t, 2> extent{rows, width};
    const Handle space(
        H5Screate_simple(width == 1 ? 1 : 2, extent.data(), nullptr), H5Sclose, action);
    const Handle list = creation(H5P_DATASET_CREATE);
    Handle dataset(H5Dcreate2(group.id(),
                              encode_link(name).c_str(),
                              type,
                              space.id(),
                              H5P_DEFAULT,
                              list.id(),
                              H5P_DEFAULT),
                   H5Dclose,
                   action);
    if (rows > 0) {
        must(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), action);
    }
    return dataset;
}

Handle open_dataset(const Handle& group, const std::string& name) {
    return {H5Dopen2(group.id(), encode_link(name).c_str(), H5P_DEFAULT),
            H5Dclose,
            "open the data set '" + name + "'"};
}

std::size_t element_count(const Handle& dataset) {
    const Handle space(H5Dget_space(dataset.id()), H5Sclose, "measure a data set");
    return static_cast<std::size_t>(
        must(H5Sget_simple_extent_npoints(space.id()), "measure a data set"));
}

void read_dataset(const Handle& dataset, hid_t type, void* data) {
    if (element_count(dataset) > 0) {
        must(H5Dread(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "read a data set");
    }
}

}  // namespace grainbench::io
