// Wavefront OBJ, read once, line by line.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
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

// Lines with their continuations: a backslash at a line's end joins it to the next.
class LogicalLines {
public:
    explicit LogicalLines(InputFile& file) : file_(file) {}

    bool next(std::string_view& line) {
        if (!file_.line(line)) return false;
        number_ = file_.line_number();
        if (!line.ends_with('\\')) return true;
        joined_.clear();
        do {
            joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
            if (joined_.size() > InputFile::longest_line) fail("a line over 16 MiB", "shorter ones");
            if (!file_.line(line)) line = {};
        } while (line.ends_with('\\'));
        line = joined_.append(line);
        return true;
    }

    std::uint64_t number() const { return number_; }  // of the last one's first line

private:
    InputFile& file_;
    std::string joined_;
    std::uint64_t number_ = 0;
};

// A vertex of the mesh is a corner of the file's: v, vt, vn and a look. Those of one v form a list: its first, then the
// others, newest first.
struct Corner {
    std::uint32_t first;  // of its list
    std::uint32_t next;
    std::uint32_t uv, normal, look;
};

class ObjReader {
public:
    ObjReader(const std::filesystem::path& path, Warnings& warnings)
        : file_(path, "an OBJ file"), materials_(path.parent_path(), warnings), looks_(1) {}

    Mesh read() {
        LogicalLines lines(file_);
        try {
            std::string_view line;
            while (lines.next(line)) read_line(line);
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
        if (keyword == "v" || keyword == "vt" || keyword == "vn" || keyword == "f")
            words = Words(words.rest().substr(0, words.rest().find('#')));
        if (keyword == "v")
            read_vertex(words);
        else if (keyword == "vt")
            read_uv(words);
        else if (keyword == "vn")
            normals_.push_back(read_vector(words));
        else if (keyword == "f")
            read_face(words);
        else if (keyword == "usemtl")
            use_material(words.rest());
        else if (keyword == "mtllib")
            materials_.add_libraries(words.rest());
    }

    static glm::vec3 read_vector(Words& words) {
        glm::vec3 vector;
        for (int i = 0; i < 3; ++i) vector[i] = to_float(words.next());
        return vector;
    }

    // v x y z [w] or v x y z r g b.
    void read_vertex(Words& words) {
        positions_.push_back(read_vector(words));
        first_.push_back(none);
        std::array<float, 3> more{};
        std::size_t count = 0;
        for (; count < more.size() && !words.at_end(); ++count) more[count] = to_float(words.next());
        const bool colored = count == more.size();
        if (colored && colors_.empty()) colors_.resize(positions_.size() - 1, glm::u8vec3(255));
        if (colored)
            colors_.emplace_back(unit_byte(more[0]), unit_byte(more[1]), unit_byte(more[2]));
        else if (!colors_.empty())
            colors_.emplace_back(255);
    }

    // vt u [v [w]]: v counts from the bottom.
    void read_uv(Words& words) {
        const float u = to_float(words.next());
        uvs_.emplace_back(u, 1.0f - (words.at_end() ? 0.0f : to_float(words.next())));
    }

    void read_face(Words& words) {
        std::uint32_t first = none, previous = none;
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const std::uint32_t vertex = read_corner(word);
            if (first == none) {
                first = vertex;
            } else {
                if (previous != none) add_triangle({first, previous, vertex});
                previous = vertex;
            }
        }
    }

    void add_triangle(const std::array<std::uint32_t, 3>& corners) {
        if (mesh_.indices.size() + 3 > most_corners) fail("more than 2^31 corners of triangles", "fewer");
        mesh_.indices.insert(mesh_.indices.end(), corners.begin(), corners.end());
    }

    // v, v/t, v//n or v/t/n.
    std::uint32_t read_corner(std::string_view word) {
        const std::size_t slash = word.find('/');
        const std::uint32_t v = index_of(word.substr(0, slash), positions_.size(), "vertex");
        std::uint32_t t = none, n = none;
        if (slash != std::string_view::npos) {
            const std::string_view rest = word.substr(slash + 1);
            const std::size_t second = rest.find('/');
            if (const std::string_view part = rest.substr(0, second); !part.empty())
                t = index_of(part, uvs_.size(), "texture coordinate");
            if (second != std::string_view::npos && second + 1 < rest.size())
                n = index_of(rest.substr(second + 1), normals_.size(), "normal");
        }
        return vertex_of(v, t, n);
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

    // The vertex of these, a new one if need be. A list is looked through only so far: of a position in thousands of
    // looks a vertex may come twice.
    std::uint32_t vertex_of(std::uint32_t v, std::uint32_t t, std::uint32_t n) {
        constexpr int patience = 32;
        std::uint32_t vertex = first_[v];
        for (int i = 0; i < patience && vertex != none; ++i) {
            const Corner& corner = corners_[vertex];
            if (corner.uv == t && corner.normal == n && corner.look == look_) return vertex;
            vertex = corner.next;
        }
        return add_vertex(v, t, n);
    }

    std::uint32_t add_vertex(std::uint32_t v, std::uint32_t t, std::uint32_t n) {
        const std::uint32_t vertex = static_cast<std::uint32_t>(corners_.size());
        if (corners_.size() >= most_corners) fail("more than 2^31 vertices", "fewer");
        if (first_[v] == none) {
            first_[v] = vertex;
            corners_.push_back({vertex, none, t, n, look_});
        } else {
            corners_.push_back({first_[v], std::exchange(corners_[first_[v]].next, vertex), t, n, look_});
        }
        mesh_.positions.push_back(positions_[v]);
        const ObjLook& look = looks_[look_];
        const glm::u8vec3 own = colors_.empty() ? glm::u8vec3(255) : colors_[v];
        mesh_.colors.emplace_back(product(own.r, look.color.r), product(own.g, look.color.g),
                                  product(own.b, look.color.b), 255);
        return vertex;
    }

    void use_material(std::string_view name) {
        const auto [at, added] =
            look_of_material_.try_emplace(std::string(name), static_cast<std::uint32_t>(looks_.size()));
        if (added) looks_.push_back(materials_.look_of(name));
        look_ = at->second;
    }

    // Frees what the file's own lists hold as it goes.
    Mesh finish() {
        positions_ = {};
        first_ = {};
        colors_ = {};
        const std::uint16_t plain = number_of({}, mesh_.materials);
        std::vector<std::uint16_t> materials;
        for (const ObjLook& look : looks_) materials.push_back(number_of({.texture = look.texture}, mesh_.materials));
        mesh_.uvs.reserve(corners_.size());
        for (const Corner& corner : corners_) {
            mesh_.uvs.push_back(corner.uv == none ? glm::vec2(0.0f) : uvs_[corner.uv]);
            mesh_.material_ids.push_back(corner.uv == none ? plain : materials[corner.look]);
        }
        uvs_ = {};
        std::vector<std::uint32_t> places(corners_.size());
        mesh_.normals.reserve(corners_.size());
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            mesh_.normals.push_back(corners_[i].normal == none ? glm::vec3(0.0f) : normals_[corners_[i].normal]);
            places[i] = corners_[i].first;
        }
        normals_ = {};
        corners_ = {};
        complete_normals(mesh_.positions, mesh_.indices, places, mesh_.normals);
        mesh_.textures = materials_.take_textures();
        return std::move(mesh_);
    }

    InputFile file_;
    bool at_start_ = true;
    ObjMaterials materials_;
    std::vector<ObjLook> looks_;  // the first: no material
    std::map<std::string, std::uint32_t, std::less<>> look_of_material_;
    std::uint32_t look_ = 0;

    // The file's own lists.
    std::vector<glm::vec3> positions_, normals_;
    std::vector<glm::u8vec3> colors_;  // empty, or as many as positions
    std::vector<glm::vec2> uvs_;
    std::vector<std::uint32_t> first_;  // of each position's vertices

    std::vector<Corner> corners_;  // one a vertex of the mesh
    Mesh mesh_;
};

}  // namespace

Mesh read_obj(const std::filesystem::path& path, Warnings& warnings) {
    return ObjReader(path, warnings).read();
}

}  // namespace model
