// Wavefront OBJ, read once, line by line.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/input_file.h"
#include "model/io/materials.h"
#include "model/io/mesh_readers.h"
#include "model/io/normals.h"
#include "model/io/obj_materials.h"
#include "model/io/origin.h"
#include "model/io/positions.h"
#include "model/io/triangulate.h"
#include "model/io/vertex_splits.h"
#include "model/io/words.h"
#include "model/srgb.h"

namespace model {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// Both sRGB-encoded; multiplied as light.
std::uint8_t product(std::uint8_t a, std::uint8_t b) {
    return srgb_of_linear(linear_of_srgb(a) * linear_of_srgb(b));
}

// Whether its numbers may go on in the next line. A backslash at the end of a comment or of a name joins nothing.
bool has_numbers(std::string_view keyword) {
    return keyword == "v" || keyword == "vt" || keyword == "vn" || keyword == "f";
}

// Microsoft's NaN, 1.#IND, has no comment.
std::string_view without_comment(std::string_view text) {
    std::size_t at = text.find('#');
    while (at != std::string_view::npos && at > 0 && text[at - 1] == '.' && at + 1 < text.size() &&
           std::string_view("IQS").find(text[at + 1]) != std::string_view::npos)
        at = text.find('#', at + 1);
    return text.substr(0, at);
}

// Lines with their continuations: a backslash at a line's end, blanks or none behind it, joins it to the next.
class LogicalLines {
public:
    explicit LogicalLines(InputFile& file) : file_(file) {}

    bool next(std::string_view& line) {
        if (!file_.line(line)) return false;
        number_ = file_.line_number();
        if (!goes_on(line) || !has_numbers(Words(line).next())) return true;
        joined_.clear();
        do {
            joined_.append(line.substr(0, line.rfind('\\'))).push_back(' ');
            if (joined_.size() > InputFile::longest_line) fail("a line over 16 MiB", "shorter ones");
            if (!file_.line(line)) line = {};
        } while (goes_on(line));
        line = joined_.append(line);
        return true;
    }

    std::uint64_t number() const { return number_; }  // of the last one's first line

private:
    static bool goes_on(std::string_view line) {
        const std::size_t last = line.find_last_not_of(" \t\v\f\r");
        return last != std::string_view::npos && line[last] == '\\' && line.find('#') == std::string_view::npos;
    }

    InputFile& file_;
    std::string joined_;
    std::uint64_t number_ = 0;
};

// What a vertex of the mesh has of the file's lists.
struct Corner {
    std::uint32_t uv, look;
    std::uint32_t normal;  // or own_normal + the number of a smoothing group

    bool operator==(const Corner&) const = default;
};

// Normals are the surface's, shared within the group.
constexpr std::uint32_t own_normal = std::uint32_t{1} << 31;

// Of a place the surface is smooth across looks. Normals that the file gives are those of the group of all, if ever.
bool smooth(const Corner& a, const Corner& b) {
    return std::max(a.normal, own_normal) == std::max(b.normal, own_normal);
}

class ObjReader {
public:
    ObjReader(const std::filesystem::path& path, Warnings& warnings)
        : file_(path, "an OBJ file", InputFile::Packing::unpacked),
          warnings_(warnings),
          materials_(path.parent_path(), warnings),
          looks_(1) {}

    Mesh read() {
        LogicalLines lines(file_);
        try {
            std::string_view line;
            while (lines.next(line)) {
                line_ = lines.number();
                read_line(line);
            }
        } catch (const std::runtime_error& error) {
            const std::uint64_t number = std::max<std::uint64_t>(lines.number(), 1);
            throw std::runtime_error("line " + std::to_string(number) + ": " + error.what());
        }
        return finish();
    }

private:
    void read_line(std::string_view line) {
        if (std::exchange(at_start_, false) && line.starts_with(byte_order_mark))
            line.remove_prefix(byte_order_mark.size());
        Words words(line);
        const std::string_view keyword = words.next();
        // Names may hold a #; what stands after numbers is a comment.
        if (has_numbers(keyword)) words = Words(without_comment(words.rest()));
        if (keyword == "v")
            read_vertex(words);
        else if (keyword == "vt")
            read_uv(words);
        else if (keyword == "vn")
            read_normal(words);
        else if (keyword == "f")
            read_face(words);
        else if (keyword == "s")
            use_group(words.next());
        else if (keyword == "usemtl")
            use_material(words.rest());
        else if (keyword == "mtllib")
            materials_.add_libraries(words.rest());
    }

    void say(std::string_view what) { warnings_.add(what, "line " + std::to_string(line_)); }

    // v x y z [w] or v x y z r g b. Faces must not use one that is not finite.
    void read_vertex(Words& words) {
        glm::dvec3 position;
        for (int i = 0; i < 3; ++i) position[i] = to_double(words.next());
        positions_.push_back(position);
        splits_.add_place();
        std::array<float, 3> more{};
        std::size_t count = 0;
        for (; count < more.size() && !words.at_end(); ++count)
            more[count] = static_cast<float>(to_double_or_nan(words.next()));
        bool colored = count == more.size();
        if (colored && !std::isfinite(more[0] + more[1] + more[2])) {
            say("vertex colour is no number, left white");
            colored = false;
        }
        if (colored && colors_.empty()) colors_.resize(positions_.size() - 1, glm::u8vec3(255));
        if (colored)
            colors_.emplace_back(unit_byte(more[0]), unit_byte(more[1]), unit_byte(more[2]));
        else if (!colors_.empty())
            colors_.emplace_back(255);
    }

    // vt u [v [w]]: v counts from the bottom.
    void read_uv(Words& words) {
        const auto u = static_cast<float>(to_double_or_nan(words.next()));
        const auto v = words.at_end() ? 0.0f : static_cast<float>(to_double_or_nan(words.next()));
        const bool finite = std::isfinite(u) && std::isfinite(v);
        if (!finite) say("texture coordinate is no number, set to 0");
        uvs_.push_back(finite ? glm::vec2(u, 1.0f - v) : glm::vec2(0.0f));
    }

    void read_normal(Words& words) {
        glm::vec3 normal;
        for (int i = 0; i < 3; ++i) normal[i] = static_cast<float>(to_double_or_nan(words.next()));
        const bool finite = std::isfinite(normal.x) && std::isfinite(normal.y) && std::isfinite(normal.z);
        if (!finite) say("normal is no number, computed");
        if (normals_.size() == own_normal) fail("more than 2^31 normals", "fewer");
        normals_.push_back(finite ? normal : glm::vec3(0.0f));
    }

    // s off and s 0: every face is flat by itself. What stands before any s is one surface.
    void use_group(std::string_view name) {
        flat_ = name == "off" || name == "0";
        if (flat_) return;
        const auto [at, added] = group_of_name_.try_emplace(std::string(name), groups_);
        if (added) ++groups_;
        group_ = at->second;
    }

    void read_face(Words& words) {
        vertices_.clear();
        corners_.clear();
        if (flat_) group_ = groups_++;
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) read_corner(word);
        for (const auto& triangle : triangulator_.cut(corners_)) {
            if (mesh_.indices.size() + 3 > most_corners) fail("more than 2^31 corners of triangles", "fewer");
            for (const std::uint32_t corner : triangle) mesh_.indices.push_back(vertices_[corner]);
        }
    }

    // v, v/t, v//n or v/t/n.
    void read_corner(std::string_view word) {
        const std::size_t slash = word.find('/');
        const std::uint32_t v = index_of(word.substr(0, slash), positions_.size(), "vertex");
        std::uint32_t t = none, n = own_normal + group_;
        if (slash != std::string_view::npos) {
            const std::string_view rest = word.substr(slash + 1);
            const std::size_t second = rest.find('/');
            if (const std::string_view part = rest.substr(0, second); !part.empty())
                t = index_of(part, uvs_.size(), "texture coordinate");
            if (second != std::string_view::npos && second + 1 < rest.size())
                n = index_of(rest.substr(second + 1), normals_.size(), "normal");
        }
        check_face_corners(corners_.size() + 1);
        corners_.push_back(positions_[v]);
        check_finite(corners_.back(), v + std::uint64_t{1});
        if (splits_.vertices().size() >= most_corners) fail("more than 2^31 vertices", "fewer");
        vertices_.push_back(splits_.vertex_of(v, {t, look_, n}));
    }

    // From 1, or from the end where it is negative.
    static std::uint32_t index_of(std::string_view word, std::size_t count, const char* what) {
        const std::int64_t number = to_integer(word);
        const std::int64_t size = static_cast<std::int64_t>(count);
        const std::int64_t index = number < 0 ? number + size : number - 1;
        if (number == 0 || index < 0 || index >= size)
            fail(std::string(what) + ' ' + std::to_string(number),
                 count == 0 ? "one that is defined before" : "1 to " + std::to_string(count));
        return static_cast<std::uint32_t>(index);
    }

    void use_material(std::string_view name) {
        const auto [at, added] =
            look_of_material_.try_emplace(std::string(name), static_cast<std::uint32_t>(looks_.size()));
        if (added) looks_.push_back(materials_.look_of(name));
        look_ = at->second;
    }

    // Frees what the file's own lists hold as it goes.
    Mesh finish() {
        const auto& vertices = splits_.vertices();
        place(mesh_, vertices.size(), [&](std::size_t i) { return positions_[vertices[i].place]; });
        positions_ = {};
        add_looks();
        mesh_.normals.reserve(vertices.size());
        for (const auto& vertex : vertices)
            mesh_.normals.push_back(vertex.look.normal >= own_normal ? glm::vec3(0.0f) : normals_[vertex.look.normal]);
        normals_ = {};
        const std::vector<std::uint32_t> places = splits_.alike(smooth);
        splits_ = {};
        complete_normals(mesh_.positions, mesh_.indices, places, mesh_.normals);
        mesh_.textures = materials_.take_textures();
        return std::move(mesh_);
    }

    void add_looks() {
        const std::uint16_t plain = number_of({}, mesh_.materials);
        std::vector<std::uint16_t> materials;
        for (const ObjLook& look : looks_) {
            Material material;
            material.texture = look.texture;
            materials.push_back(number_of(material, mesh_.materials));
        }
        const std::size_t count = splits_.vertices().size();
        mesh_.colors.reserve(count);
        mesh_.uvs.reserve(count);
        for (const auto& [v, next, corner] : splits_.vertices()) {
            if (corner.uv == none && looks_[corner.look].texture != no_texture)
                warnings_.add("texture without coordinates, left out", "vertex " + std::to_string(v + 1));
            const glm::u8vec3 own = colors_.empty() ? glm::u8vec3(255) : colors_[v], look = looks_[corner.look].color;
            mesh_.colors.emplace_back(product(own.r, look.r), product(own.g, look.g), product(own.b, look.b), 255);
            mesh_.uvs.push_back(corner.uv == none ? glm::vec2(0.0f) : uvs_[corner.uv]);
            mesh_.material_ids.push_back(corner.uv == none ? plain : materials[corner.look]);
        }
        colors_ = {};
        uvs_ = {};
    }

    InputFile file_;
    Warnings& warnings_;
    bool at_start_ = true;
    std::uint64_t line_ = 0;
    ObjMaterials materials_;
    std::vector<ObjLook> looks_;  // the first: no material
    std::map<std::string, std::uint32_t, std::less<>> look_of_material_;
    std::uint32_t look_ = 0;
    std::map<std::string, std::uint32_t, std::less<>> group_of_name_;
    std::uint32_t group_ = 0, groups_ = 1;
    bool flat_ = false;

    // The file's own lists.
    Positions positions_;
    std::vector<glm::vec3> normals_;
    std::vector<glm::u8vec3> colors_;  // empty, or as many as positions
    std::vector<glm::vec2> uvs_;

    VertexSplits<Corner> splits_;
    Triangulator triangulator_;
    std::vector<std::uint32_t> vertices_;  // of the face that is read
    std::vector<glm::dvec3> corners_;
    Mesh mesh_;
};

}  // namespace

Mesh read_obj(const std::filesystem::path& path, Warnings& warnings) {
    return ObjReader(path, warnings).read();
}

}  // namespace model
