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
#include "model/io/mesh_textures.h"
#include "model/io/polygon_mesh.h"
#include "model/io/words.h"

namespace model {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class Format { ascii, little, big };

// What a property is to us.
enum Role { x, y, z, nx, ny, nz, red, green, blue, u, v, texture_number, corners, wedges, skipped };
constexpr std::size_t scalar_roles = corners;

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
    std::vector<std::string> textures;
    std::vector<Element> elements;

    const Element* find(std::string_view name) const {
        const auto found = std::find_if(elements.begin(), elements.end(),
                                        [&](const Element& element) { return element.name == name; });
        return found == elements.end() ? nullptr : &*found;
    }
    bool has(std::string_view element, Role first, Role last) const {
        const Element* found = find(element);
        return found && found->has(first, last);
    }
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

Role scalar_role_of(std::string_view property) {
    // By their order, and what others call them.
    static constexpr std::array<std::array<std::string_view, 4>, scalar_roles> names{{{"x"},
                                                                                      {"y"},
                                                                                      {"z"},
                                                                                      {"nx"},
                                                                                      {"ny"},
                                                                                      {"nz"},
                                                                                      {"red", "diffuse_red", "r"},
                                                                                      {"green", "diffuse_green", "g"},
                                                                                      {"blue", "diffuse_blue", "b"},
                                                                                      {"texture_u", "u", "s"},
                                                                                      {"texture_v", "v", "t"},
                                                                                      {"texnumber"}}};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (std::find(names[i].begin(), names[i].end(), property) != names[i].end()) return static_cast<Role>(i);
    return skipped;
}

Role role_of(const std::string& element, std::string_view property, bool list) {
    if (element != "vertex" && element != "face" && element != "tristrips") return skipped;
    if (!list) return element == "tristrips" ? skipped : scalar_role_of(property);
    if (element == "vertex") return skipped;
    if (property == "vertex_indices" || property == "vertex_index") return corners;
    return element == "face" && property == "texcoord" ? wedges : skipped;
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

bool is_same(std::string_view word, std::string_view lower_case) {
    return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
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
        if (keyword == "comment" && is_same(words.next(), "texturefile")) header.textures.emplace_back(words.rest());
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
        return type == Type::f32 || type == Type::f64 ? to_double(word) : static_cast<double>(to_integer(word));
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

// Bytes as they are; 16 bits and fractions scaled to them. NaN is 255.
std::uint8_t color_of(double value, Type type) {
    double scaled = value;
    if (type == Type::u16) scaled = value / 257;
    if (type == Type::f32 || type == Type::f64) scaled = 255 * value;
    return std::isnan(scaled) ? std::uint8_t{255}
                              : static_cast<std::uint8_t>(std::lround(std::clamp(scaled, 0.0, 255.0)));
}

// A face as it stands in the file.
struct PlyFace {
    std::vector<std::uint32_t> corners;
    std::vector<glm::vec2> uvs;
    std::optional<glm::u8vec4> color;
    std::uint8_t texture = no_texture;
};

// The header's textures, if anything has coordinates for them.
std::vector<std::uint8_t> textures_of(const Header& header, MeshTextures& textures, Warnings& warnings) {
    std::vector<std::uint8_t> ids;
    const bool used = header.has("vertex", u, v) || header.has("face", wedges, wedges);
    for (const std::string& name : header.textures) {
        if (used)
            ids.push_back(textures.of_file(name));
        else
            warnings.add("texture without coordinates, left out", name);
    }
    return ids;
}

PolygonMesh::Looks looks_of(const Header& header, const std::vector<std::uint8_t>& textures) {
    const bool textured =
        std::any_of(textures.begin(), textures.end(), [](std::uint8_t id) { return id != no_texture; });
    const bool colored = header.has("face", red, blue) && !header.has("vertex", red, blue);
    return colored || (textured && header.has("face", wedges, wedges)) ? PolygonMesh::Looks::of_faces
                                                                       : PolygonMesh::Looks::of_vertices;
}

template <typename Source>
class Body {
public:
    Body(Source source, const Header& header, std::vector<std::uint8_t> textures, std::uint64_t room,
         Warnings& warnings)
        : source_(std::move(source)),
          header_(header),
          textures_(std::move(textures)),
          room_(room),
          warnings_(warnings),
          mesh_(looks_of(header, textures_)) {
        if (const Element* vertices = header.find("vertex")) vertex_count_ = vertices->count;
        if (!textures_.empty()) mesh_.texture = textures_[0];
    }

    Mesh read() {
        for (const Element& element : header_.elements) read_element(element);
        for (const PlyFace& face : early_) mesh_.add_face({face.corners, face.color, face.uvs, face.texture});
        return mesh_.finish(warnings_);
    }

private:
    void read_element(const Element& element) {
        if (element.properties.empty()) return;  // nothing is in the file, whatever the count says
        if (element.name == "vertex") prepare(element);
        if (element.name == "face") mesh_.reserve_corners(std::min(3 * element.count, room_ / sizeof(std::uint32_t)));
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

    void prepare(const Element& element) {
        has_normals_ = element.has(nx, nz);
        has_colors_ = element.has(red, blue);
        has_uvs_ = element.has(u, v) && mesh_.texture != no_texture;
        if (room_ == 0) return;
        const std::size_t count = static_cast<std::size_t>(element.count);
        mesh_.positions.reserve(count);
        if (has_normals_) mesh_.normals.reserve(count);
        if (has_colors_) mesh_.colors.reserve(count);
        if (has_uvs_) mesh_.uvs.reserve(count);
    }

    using Values = std::array<double, scalar_roles>;

    void read_scalar(const Property& property, Values& values) {
        const double value = source_.number(property.type);
        const bool color = property.role >= red && property.role <= blue;
        if (color && !std::isfinite(value)) warnings_.add("colour is no number, left white", text_of(value));
        values[property.role] = color ? color_of(value, property.type) : value;
    }

    // v counts from the bottom.
    static glm::vec2 uv_of(double across, double up) {
        return {static_cast<float>(across), 1.0f - static_cast<float>(up)};
    }

    void read_vertex(const Element& element) {
        Values values{};
        for (const Property& property : element.properties) {
            if (property.role == skipped)
                skip(property);
            else
                read_scalar(property, values);
        }
        mesh_.positions.push_back({values[x], values[y], values[z]});
        if (has_normals_) mesh_.normals.emplace_back(values[nx], values[ny], values[nz]);
        if (has_colors_) mesh_.colors.emplace_back(values[red], values[green], values[blue], 255);
        if (has_uvs_) mesh_.uvs.push_back(uv_of(values[u], values[v]));
    }

    // Faces, strips, and what is passed over.
    void read_other(const Element& element) {
        Values values{};
        face_ = {std::move(face_.corners), std::move(face_.uvs), std::nullopt, mesh_.texture};
        face_.corners.clear();
        face_.uvs.clear();
        const bool strips = element.name == "tristrips";
        for (const Property& property : element.properties) {
            if (property.role == corners && strips)
                read_strips(property);
            else if (property.role == corners)
                read_corners(property);
            else if (property.role == wedges)
                read_wedges(property);
            else if (property.role == skipped)
                skip(property);
            else
                read_scalar(property, values);
        }
        if (strips || element.name != "face") return;
        if (element.has(red, blue) && !header_.has("vertex", red, blue))
            face_.color = glm::u8vec4(values[red], values[green], values[blue], 255);
        if (element.has(texture_number, texture_number)) face_.texture = texture_at(values[texture_number]);
        check_wedges();
        add_face();
    }

    std::uint8_t texture_at(double number) const {
        const bool exists = number >= 0 && number < static_cast<double>(textures_.size());
        return exists ? textures_[static_cast<std::size_t>(number)] : no_texture;
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

    void read_corners(const Property& property) {
        for (std::uint64_t left = length_of(*property.count_type); left > 0; --left) {
            check_face_corners(face_.corners.size() + 1);
            face_.corners.push_back(corner_of(source_.number(property.type)));
        }
    }

    // u and v of each corner, one after another.
    void read_wedges(const Property& property) {
        const std::uint64_t count = length_of(*property.count_type);
        for (std::uint64_t i = 0; i + 1 < count; i += 2) {
            check_face_corners(face_.uvs.size() + 1);
            const double across = source_.number(property.type);
            face_.uvs.push_back(uv_of(across, source_.number(property.type)));
        }
        if (count % 2 == 1) source_.skip(property.type, 1);
    }

    void check_wedges() {
        if (face_.uvs.empty() || face_.uvs.size() == face_.corners.size()) return;
        warnings_.add("texture coordinates not one a corner, left out", "");
        face_.uvs.clear();
    }

    // Every corner makes a triangle with the two before it; every other one of a strip is wound backwards. -1 begins
    // another strip.
    void read_strips(const Property& property) {
        std::array<std::uint32_t, 3> last{};
        std::uint64_t in_strip = 0;
        for (std::uint64_t left = length_of(*property.count_type); left > 0; --left) {
            const double number = source_.number(property.type);
            if (number == -1) {
                in_strip = 0;
                continue;
            }
            last = {last[1], last[2], corner_of(number)};
            const bool repeats = last[0] == last[1] || last[1] == last[2] || last[0] == last[2];
            if (++in_strip < 3 || repeats) continue;
            face_.corners.assign(last.begin(), last.end());
            if (in_strip % 2 == 0) std::swap(face_.corners[0], face_.corners[1]);
            add_face();
        }
    }

    std::uint32_t corner_of(double index) const {
        if (!(index >= 0) || index >= static_cast<double>(vertex_count_))
            fail("vertex " + text_of(index), "0 to below " + std::to_string(vertex_count_));
        return static_cast<std::uint32_t>(index);
    }

    // Faces may stand before the vertices.
    void add_face() {
        if (mesh_.positions.size() == vertex_count_)
            mesh_.add_face({face_.corners, face_.color, face_.uvs, face_.texture});
        else
            early_.push_back(face_);
    }

    Source source_;
    const Header& header_;
    std::vector<std::uint8_t> textures_;
    std::uint64_t room_;  // [bytes] that may be reserved: the file's, if its counts are checked
    Warnings& warnings_;
    std::uint64_t vertex_count_ = 0;
    bool has_normals_ = false, has_colors_ = false, has_uvs_ = false;
    PlyFace face_;
    std::vector<PlyFace> early_;
    PolygonMesh mesh_;
};

void check_elements(const Header& header) {
    const Element* vertices = header.find("vertex");
    if (!vertices || !vertices->has(x, z)) fail("no vertices with x, y and z", "an element vertex with them");
    if (vertices->count > most_corners) fail("more than 2^31 vertices", "fewer");
    if (!header.has("face", corners, corners) && !header.has("tristrips", corners, corners))
        fail("no faces", "an element face or tristrips with a list vertex_indices");
}

}  // namespace

Mesh read_ply(const std::filesystem::path& path, Warnings& warnings) {
    InputFile file(path, "a PLY file", InputFile::Packing::unpacked);
    Header header;
    try {
        header = read_header(file);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("line " + std::to_string(std::max<std::uint64_t>(file.line_number(), 1)) + ": " +
                                 error.what());
    }
    check_elements(header);
    check_counts(header, file.left());
    MeshTextures textures(path.parent_path(), warnings);
    const auto read = [&](auto source) {
        return Body(std::move(source), header, textures_of(header, textures, warnings), file.packed() ? 0 : file.left(),
                    warnings)
            .read();
    };
    Mesh mesh = header.format == Format::ascii ? read(TextSource(file)) : read(BinarySource(file, header.format));
    mesh.textures = textures.take();
    return mesh;
}

}  // namespace model
