// PLY meshes, read once, record by record.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/input_file.h"
#include "model/io/mesh_readers.h"
#include "model/io/normals.h"
#include "model/io/words.h"

namespace model {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class Format { ascii, little, big };

// What a property is to us.
enum Role { x, y, z, nx, ny, nz, red, green, blue, corners, skipped };
constexpr std::size_t vertex_roles = corners;

struct Property {
    Type type = Type::u8;
    std::optional<Type> count_type;  // of a list
    Role role = skipped;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;

    bool has(Role first, Role last) const {
        for (int role = first; role <= last; ++role)
            if (std::none_of(properties.begin(), properties.end(), [&](const Property& p) { return p.role == role; }))
                return false;
        return true;
    }
};

struct Header {
    Format format = Format::ascii;
    std::vector<Element> elements;
};

std::size_t size_of(Type type) {
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

Type type_of(std::string_view word) {
    static constexpr std::array<std::pair<std::string_view, Type>, 16> names{{{"char", Type::i8},
                                                                              {"int8", Type::i8},
                                                                              {"uchar", Type::u8},
                                                                              {"uint8", Type::u8},
                                                                              {"short", Type::i16},
                                                                              {"int16", Type::i16},
                                                                              {"ushort", Type::u16},
                                                                              {"uint16", Type::u16},
                                                                              {"int", Type::i32},
                                                                              {"int32", Type::i32},
                                                                              {"uint", Type::u32},
                                                                              {"uint32", Type::u32},
                                                                              {"float", Type::f32},
                                                                              {"float32", Type::f32},
                                                                              {"double", Type::f64},
                                                                              {"float64", Type::f64}}};
    for (const auto& [name, type] : names)
        if (name == word) return type;
    fail(word.empty() ? "no type" : "type " + in_quotes(word), "one of PLY's, from char to double");
}

Role role_of(const std::string& element, std::string_view property, bool list) {
    if (element == "face") {
        const bool named = property == "vertex_indices" || property == "vertex_index";
        return list && named ? corners : skipped;
    }
    static constexpr std::array<std::string_view, vertex_roles> names{"x",  "y",   "z",     "nx",  "ny",
                                                                      "nz", "red", "green", "blue"};
    if (element != "vertex" || list) return skipped;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == property) return static_cast<Role>(i);
    return skipped;
}

// --- The header

Format format_of(Words& words) {
    const std::string_view name = words.next(), version = words.next();
    if (version != "1.0") fail("version " + in_quotes(version), "1.0");
    if (name == "ascii") return Format::ascii;
    if (name == "binary_little_endian") return Format::little;
    if (name == "binary_big_endian") return Format::big;
    fail("format " + in_quotes(name), "ascii, binary_little_endian or binary_big_endian");
}

Element element_of(Words& words, const Header& header) {
    Element element;
    element.name = words.next();
    const std::int64_t count = to_integer(words.next());
    if (count < 0) fail("a count of " + std::to_string(count), "0 or more");
    element.count = static_cast<std::uint64_t>(count);
    for (const Element& other : header.elements)
        if (other.name == element.name) fail("a second element " + in_quotes(element.name), "one");
    return element;
}

Property property_of(Words& words, const std::string& element) {
    Property property;
    const std::string_view type = words.next();
    const bool list = type == "list";
    if (list) property.count_type = type_of(words.next());
    property.type = type_of(list ? words.next() : type);
    const std::string_view name = words.next();
    if (name.empty()) fail("a property without a name", "property TYPE NAME");
    property.role = role_of(element, name, list);
    if (property.role == corners && (property.type == Type::f32 || property.type == Type::f64))
        fail("vertex indices that are no whole numbers", "an integer type");
    return property;
}

// Lines up to end_header.
Header read_header(InputFile& file) {
    constexpr std::size_t most_elements = 1000;
    Header header;
    std::string_view line;
    if (!file.line(line) || Words(line).rest() != "ply") fail("a file that does not begin with 'ply'", "a PLY file");
    bool has_format = false;
    while (true) {
        if (!file.line(line)) fail("a header without end", "a line end_header");
        Words words(line);
        const std::string_view keyword = words.next();
        if (keyword == "end_header") break;
        if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
        if (keyword == "format") {
            header.format = format_of(words);
            has_format = true;
        } else if (keyword == "element") {
            if (header.elements.size() == most_elements) fail("more than 1000 elements", "fewer");
            header.elements.push_back(element_of(words, header));
        } else if (keyword == "property") {
            if (header.elements.empty()) fail("a property of no element", "an element before it");
            Element& element = header.elements.back();
            element.properties.push_back(property_of(words, element.name));
        } else {
            fail(in_quotes(line), "a line of a PLY header");
        }
    }
    if (!has_format) fail("no format", "a line format ascii 1.0 or the like");
    return header;
}

// The least that an element's records take: in text a digit and a blank a value.
std::uint64_t least_bytes(const Element& element, Format format) {
    std::uint64_t bytes = 0;
    for (const Property& property : element.properties)
        bytes += format == Format::ascii ? 2 : size_of(property.count_type.value_or(property.type));
    return bytes;
}

// Before anything is reserved: headers lie.
void check_counts(const Header& header, std::uint64_t bytes) {
    std::uint64_t left = bytes + (header.format == Format::ascii ? 1 : 0);  // the last line may have no end
    for (const Element& element : header.elements) {
        const std::uint64_t least = least_bytes(element, header.format);
        if (least == 0) continue;
        if (element.count > left / least)
            fail(std::to_string(element.count) + " of element " + in_quotes(element.name) + " in " +
                     std::to_string(bytes) + " bytes",
                 "as many as it holds");
        left -= element.count * least;
    }
}

// --- Where values come from

class TextSource {
public:
    explicit TextSource(InputFile& file) : file_(file), words_({}) {}

    void begin_record() {
        std::string_view line;
        do {
            if (!file_.line(line)) fail("the end of the file", "more data");
            words_ = Words(line);
        } while (words_.at_end());
    }
    void end_record() {
        if (!words_.at_end()) fail("more values in line " + std::to_string(file_.line_number()), "the header's");
    }

    double number(Type type) {
        const std::string_view word = next();
        return type == Type::f32 || type == Type::f64 ? static_cast<double>(to_float(word))
                                                      : static_cast<double>(to_integer(word));
    }
    void skip(Type, std::uint64_t count) {
        for (; count > 0; --count) next();
    }

private:
    std::string_view next() {
        const std::string_view word = words_.next();
        if (word.empty()) fail("the end of line " + std::to_string(file_.line_number()), "another value");
        return word;
    }

    InputFile& file_;
    Words words_;
};

template <typename Number>
Number read_as(const unsigned char* bytes, bool swap) {
    std::array<unsigned char, sizeof(Number)> value;
    std::memcpy(value.data(), bytes, sizeof(Number));
    if (swap) std::reverse(value.begin(), value.end());
    return std::bit_cast<Number>(value);
}

class BinarySource {
public:
    BinarySource(InputFile& file, Format format)
        : file_(file), swap_((format == Format::big) == (std::endian::native == std::endian::little)) {}

    void begin_record() {}
    void end_record() {}

    double number(Type type) {
        const unsigned char* bytes = file_.take(size_of(type));
        switch (type) {
            case Type::i8:
                return static_cast<signed char>(*bytes);
            case Type::u8:
                return *bytes;
            case Type::i16:
                return read_as<std::int16_t>(bytes, swap_);
            case Type::u16:
                return read_as<std::uint16_t>(bytes, swap_);
            case Type::i32:
                return read_as<std::int32_t>(bytes, swap_);
            case Type::u32:
                return read_as<std::uint32_t>(bytes, swap_);
            case Type::f32:
                return read_as<float>(bytes, swap_);
            case Type::f64:
                break;
        }
        return read_as<double>(bytes, swap_);
    }
    void skip(Type type, std::uint64_t count) {
        if (count > file_.left()) fail("a list of " + std::to_string(count), "one that the file holds");
        file_.skip(size_of(type) * count);
    }

private:
    InputFile& file_;
    bool swap_;
};

// --- The body

std::string text_of(double value) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

float finite(double value) {
    const float number = static_cast<float>(value);
    if (!std::isfinite(number)) fail(text_of(value), "a finite number");
    return number;
}

// Bytes as they are; 16 bits and fractions scaled to them.
std::uint8_t color_of(double value, Type type) {
    double scaled = value;
    if (type == Type::u16) scaled = value / 257;
    if (type == Type::f32 || type == Type::f64) scaled = 255 * static_cast<double>(finite(value));
    return static_cast<std::uint8_t>(std::lround(std::clamp(scaled, 0.0, 255.0)));
}

template <typename Source>
class Body {
public:
    Body(Source source, const Header& header) : source_(std::move(source)), header_(header) {
        for (const Element& element : header.elements)
            if (element.name == "vertex") vertex_count_ = element.count;
    }

    Mesh read() {
        for (const Element& element : header_.elements) read_element(element);
        return std::move(mesh_);
    }

private:
    void read_element(const Element& element) {
        if (element.properties.empty()) return;  // nothing is in the file, whatever the count says
        if (element.name == "vertex") reserve(element);
        std::uint64_t index = 0;
        try {
            for (; index < element.count; ++index) {
                source_.begin_record();
                if (element.name == "vertex")
                    read_vertex(element);
                else
                    read_other(element);
                source_.end_record();
            }
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(element.name + " " + std::to_string(index) + ": " + error.what());
        }
    }

    void reserve(const Element& element) {
        const std::size_t count = static_cast<std::size_t>(element.count);
        mesh_.positions.reserve(count);
        has_normals_ = element.has(nx, nz);
        has_colors_ = element.has(red, blue);
        if (has_normals_) mesh_.normals.reserve(count);
        if (has_colors_) mesh_.colors.reserve(count);
    }

    void read_vertex(const Element& element) {
        std::array<double, vertex_roles> values{};
        for (const Property& property : element.properties) {
            if (property.role == skipped)
                skip(property);
            else if (property.role >= red)
                values[property.role] = color_of(source_.number(property.type), property.type);
            else
                values[property.role] = source_.number(property.type);
        }
        mesh_.positions.emplace_back(finite(values[x]), finite(values[y]), finite(values[z]));
        if (has_normals_) mesh_.normals.emplace_back(finite(values[nx]), finite(values[ny]), finite(values[nz]));
        if (has_colors_) mesh_.colors.emplace_back(values[red], values[green], values[blue], 255);
    }

    void read_other(const Element& element) {
        for (const Property& property : element.properties) {
            if (property.role == corners)
                read_face(property);
            else
                skip(property);
        }
    }

    void skip(const Property& property) {
        source_.skip(property.type, property.count_type ? length_of(*property.count_type) : 1);
    }

    std::uint64_t length_of(Type type) {
        const double length = source_.number(type);
        if (!(length >= 0) || length > std::numeric_limits<std::uint32_t>::max() || length != std::floor(length))
            fail("a list of " + text_of(length), "a whole number below 2^32");
        return static_cast<std::uint64_t>(length);
    }

    void read_face(const Property& property) {
        const std::uint64_t count = length_of(*property.count_type);
        std::uint32_t first = 0, previous = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint32_t corner = corner_of(source_.number(property.type));
            if (i == 0) first = corner;
            if (i >= 2) add_triangle({first, previous, corner});
            previous = corner;
        }
    }

    std::uint32_t corner_of(double index) const {
        if (!(index >= 0) || index >= static_cast<double>(vertex_count_))
            fail("vertex " + text_of(index), "0 to below " + std::to_string(vertex_count_));
        return static_cast<std::uint32_t>(index);
    }

    void add_triangle(const std::array<std::uint32_t, 3>& triangle) {
        if (mesh_.indices.size() + 3 > most_corners) fail("more than 2^31 corners of triangles", "fewer");
        mesh_.indices.insert(mesh_.indices.end(), triangle.begin(), triangle.end());
    }

    Source source_;
    const Header& header_;
    std::uint64_t vertex_count_ = 0;
    bool has_normals_ = false, has_colors_ = false;
    Mesh mesh_;
};

template <typename Value>
void keep(std::vector<Value>& values, const std::vector<std::uint32_t>& places) {
    if (values.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (places[i] != std::numeric_limits<std::uint32_t>::max()) values[kept++] = values[i];
    values.resize(kept);
}

// Vertices of no triangle would count in the bounds.
void drop_unused(Mesh& mesh) {
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> places(mesh.vertex_count(), unused);
    for (const std::uint32_t corner : mesh.indices) places[corner] = 0;
    if (std::find(places.begin(), places.end(), unused) == places.end()) return;
    std::uint32_t used = 0;
    for (std::uint32_t& place : places)
        if (place != unused) place = used++;
    for (std::uint32_t& corner : mesh.indices) corner = places[corner];
    keep(mesh.positions, places);
    keep(mesh.normals, places);
    keep(mesh.colors, places);
}

void check_elements(const Header& header) {
    const auto find = [&](const char* name) {
        return std::find_if(header.elements.begin(), header.elements.end(),
                            [&](const Element& element) { return element.name == name; });
    };
    const auto vertices = find("vertex"), faces = find("face");
    if (vertices == header.elements.end() || !vertices->has(x, z))
        fail("no vertices with x, y and z", "an element vertex with them");
    if (vertices->count > most_corners) fail("more than 2^31 vertices", "fewer");
    if (faces == header.elements.end() || !faces->has(corners, corners))
        fail("no faces", "an element face with a list vertex_indices");
}

}  // namespace

Mesh read_ply(const std::filesystem::path& path, Warnings&) {
    InputFile file(path, "a PLY file");
    Header header;
    try {
        header = read_header(file);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("line " + std::to_string(std::max<std::uint64_t>(file.line_number(), 1)) + ": " +
                                 error.what());
    }
    check_elements(header);
    check_counts(header, file.left());
    Mesh mesh = header.format == Format::ascii ? Body(TextSource(file), header).read()
                                               : Body(BinarySource(file, header.format), header).read();
    drop_unused(mesh);
    mesh.normals.resize(mesh.vertex_count(), glm::vec3(0.0f));
    complete_normals(mesh.positions, mesh.indices, {}, mesh.normals);
    return mesh;
}

}  // namespace model
