// figures/points.h by GL's own points.
#include "figures/points.h"

#include <cstring>

#include "render/gl/baked_vertex.h"
#include "render/gl/figure_drawer.h"
#include "render/gl/program.h"
#include "render/gl/upload.h"
#include "shaders/layout.h"

namespace render::gl {

namespace {

struct Objects {
    Buffer points;
    VertexArray array;
    GLuint records = 0;  // a pose
    Buffer own_lights;
    bool has_own_lights = false;
};

std::vector<Record> records_of(std::span<const figures::PointLook> looks) {
    std::vector<Record> records;
    for (const figures::PointLook& look : looks) {
        Record& record = records.emplace_back(
            Record{look.point, {{}, look.color.r, look.color.g, look.color.b, look.two_sided, {}}});
        std::memcpy(record.look.extra.data(), look.shares.data(), look.shares.size());
    }
    return records;
}

Buffer upload_own_lights(std::span<const figures::PointLook> looks, std::size_t poses) {
    std::vector<glm::u8vec4> own_lights;
    own_lights.reserve(poses * looks.size());
    for (std::size_t pose = 0; pose < poses; ++pose)
        for (const figures::PointLook& look : looks) own_lights.push_back(look.own_light);
    return upload<glm::u8vec4>(own_lights);
}

class PointDrawer final : public FigureDrawer {
public:
    PointDrawer()
        : program_(build_program("person_points.vert", "person_points.frag")),
          own_light_program_(build_program("person_points.vert", "person_points.frag", {"OWN_LIGHT"})) {}

    void add(const figures::Figure& figure, const Buffer& instances) override {
        Objects& objects = objects_.emplace_back();
        if (figure.poses->point_count == 0) return;  // has no level to be drawn at
        const std::vector<figures::PointLook> looks = figures::point_looks(figure);
        const std::vector<Record> records = records_of(looks);
        objects.points = upload_poses(figure.poses->points, figure.poses->point_count, records);
        objects.records = static_cast<GLuint>(records.size());
        objects.array = make_person_array(objects.points, instances, Extra::shares);
        objects.has_own_lights = !figure.points->own_lights.empty();
        if (!objects.has_own_lights) return;
        objects.own_lights = upload_own_lights(looks, static_cast<std::size_t>(figure.poses->pose_count));
        add_own_lights(objects.array, objects.own_lights);
    }

    void append_command(const Batch& batch, std::vector<std::uint32_t>& words) const override {
        const GLuint first = batch.pose * objects_[batch.character].records + batch.first;
        words.insert(words.end(), {batch.count, batch.instance_count, first, batch.first_instance});
    }

    bool draws_points() const override { return true; }

    void draw(std::uint32_t character, std::uintptr_t offset, GLsizei count) const override {
        const Objects& objects = objects_[character];
        glUseProgram((objects.has_own_lights ? own_light_program_ : program_).name());
        glBindVertexArray(objects.array.name());
        glMultiDrawArraysIndirect(GL_POINTS, reinterpret_cast<const void*>(offset), count, 0);
    }

private:
    Program program_, own_light_program_;
    std::vector<Objects> objects_;
};

}  // namespace

std::unique_ptr<FigureDrawer> make_point_drawer() {
    return std::make_unique<PointDrawer>();
}

}  // namespace render::gl
