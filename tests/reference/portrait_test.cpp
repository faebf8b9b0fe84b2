// One person at a time before the sky: pose, place, colour and light of every pixel.
#include <algorithm>
#include <cmath>
#include <memory>

#include "scene/cast.h"
#include "scene/person.h"
#include "tests/reference/harlequin.h"
#include "tests/reference/own_light.h"
#include "tests/reference/studio.h"
#include "tests/render/gl_test.h"

namespace {

using reference::camera;
using reference::Comparison;
using reference::Model;
using reference::Person;
using reference::sitter;

constexpr int width = 200, height = 160;  // [px] unless a test changes it
const scene::StaticMesh nothing{{{}, {}, {}}, {0, 0, 0}, {}};

class Portrait : public tests::GlTest {
protected:
    // Where all is edges anything may be shown: see that it isn't so.
    void TearDown() override { EXPECT_GE(plain_surface_, least_plain_share_ * surface_); }

    void expect_alike(render::gl::Renderer& renderer, const std::vector<const Model*>& models,
                      const std::vector<Person>& people, const scene::CameraPose& pose, double splat_size,
                      const std::string& what) {
        const reference::Scene scene{{pose, size_.x, size_.y}, people, structure_, {}, 0, splat_size};
        const render::View view = render::make_view(pose, size_.x, size_.y);
        renderer.draw(reference::frame_of(people, models, view, splat_size));
        const reference::Picture expected = reference::draw(scene);
        const Comparison found = reference::compare(renderer.read_image(), expected);
        // Slivers thinner than the places that the reference looks at are left.
        EXPECT_LE(found.wrong_plain, 1) << what << ": " << found.text();
        EXPECT_LE(found.wrong, found.pixels / 2000) << what << ": " << found.text();
        surface_ += found.surface;
        plain_surface_ += found.plain_surface;
    }

    void expect_alike_all_around(const Model& model) {
        render::gl::Renderer renderer(nothing, {}, {}, std::vector{model.product()}, width, height);
        for (const reference::Sitting& one : reference::all_around(model, {0.35, 1.2, 3.0, 12.0, 90.0, 400.0}))
            expect_alike(renderer, {&model}, {one.person}, one.pose, 0, one.what);
    }

    void expect_alike_by_every_number_of_points(const Model& model) {
        render::gl::Renderer renderer(nothing, {}, {}, std::vector{model.product()}, width, height);
        const int last = std::max(0, static_cast<int>(model.clips.size()) - 1);
        for (std::size_t power = 2; power <= model.points.size(); power *= 2) {
            for (const std::size_t points : {power, power + power / 2}) {
                if (points > model.points.size()) break;
                for (Person person : {sitter(model, 0, 5), sitter(model, last, 23)}) {
                    person.points = points;
                    for (const double distance : {2.5, 14.0, 120.0}) {
                        const double side = static_cast<double>(points) + person.slot;
                        const double splat_size = std::clamp(std::floor(160 / distance / std::sqrt(points)), 1.0, 16.0);
                        expect_alike(renderer, {&model}, {person}, camera(person, side, 0.2, distance), splat_size,
                                     model.character.name + " by " + std::to_string(points) + " points, S " +
                                         std::to_string(splat_size) + " px from " + std::to_string(distance) + " m");
                    }
                }
            }
        }
    }

    glm::ivec2 size_{width, height};                // [px]
    const scene::StaticMesh* structure_ = nullptr;  // what stands beside the people

    double least_plain_share_ = 0.5;

private:
    int surface_ = 0, plain_surface_ = 0;  // [px] over all pictures of a test
};

std::unique_ptr<Model> built_in() {
    model::Character person = scene::make_person();
    const std::vector<int> clips = scene::cast(person).clips;
    return std::make_unique<Model>(std::move(person), clips, 600);
}

std::unique_ptr<Model> harlequin(bool open) {
    return std::make_unique<Model>(reference::make_harlequin(open), std::vector{0, 1}, 800);
}

// A file, and the clip that it is seen in, whatever a casting makes of it.
struct Sitter {
    const char* file;
    int clip;
};

class RealPortrait : public Portrait, public testing::WithParamInterface<Sitter> {
public:
    static std::unique_ptr<Model> model() {
        return reference::model_of_file(GetParam().file, figures::by_opengl(), {GetParam().clip});
    }
};

TEST_P(RealPortrait, IsTheReferences) {
    const std::unique_ptr<Model> model = RealPortrait::model();
    if (!model) GTEST_SKIP() << "NO ../shared/assets/" << GetParam().file << ", IT IS NOT DRAWN";
    expect_alike_all_around(*model);
}

TEST_P(RealPortrait, IsTheReferencesByAnyNumberOfPoints) {
    const std::unique_ptr<Model> model = RealPortrait::model();
    if (!model) GTEST_SKIP() << "NO ../shared/assets/" << GetParam().file << ", IT IS NOT DRAWN";
    expect_alike_by_every_number_of_points(*model);
}

INSTANTIATE_TEST_SUITE_P(Files, RealPortrait,
                         testing::Values(Sitter{"CesiumMan/CesiumMan.glb", 0}, Sitter{"Fox/Fox.glb", 0},
                                         Sitter{"KayKitMage/Mage.glb", 70},
                                         Sitter{"QuaterniusKnight/KnightCharacter.glb", 0},
                                         Sitter{"RaylibRobot/robot.glb", 0}),
                         [](const auto& test) {
                             const std::string name = test.param.file;
                             return name.substr(0, name.find('/'));
                         });

TEST_F(Portrait, OfWhoShinesIsTheReferences) {
    for (const reference::Shine shine : {reference::Shine::unlit, reference::Shine::glowing}) {
        const Model model(reference::make_shining_harlequin(shine), {0, 1}, 400);
        expect_alike_all_around(model);
        expect_alike_by_every_number_of_points(model);
    }
}

// Which side is seen the triangle says, not the normals.
TEST_F(Portrait, OfLeaningNormalsIsTheReferences) {
    expect_alike_all_around(Model(reference::make_leaning_harlequin(), {0, 1}, 400));
}

// Neighbours in front of and behind one another, some as triangles, some as points, whose batches follow one another in
// every way there is.
TEST_F(Portrait, OfAGroupIsTheReferences) {
    const std::unique_ptr<Model> plain = built_in(), closed = harlequin(false), open = harlequin(true);
    const std::vector<const Model*> models{plain.get(), closed.get(), open.get()};
    render::gl::Renderer renderer(nothing, {}, {}, std::vector{plain->product(), closed->product(), open->product()},
                                  width, height);
    std::vector<Person> group;
    for (int i = 0; i < 18; ++i) {
        Person person = sitter(*models[static_cast<std::size_t>((i / 2 * 5 + i / 9) % 3)], i % 2, 7 * i % 24);
        person.points = i % 3 == 0 ? 0 : i % 3 == 1 ? 6 : 384;
        person.origin += glm::dvec3(1.1 * (i % 6) - 2.5, 0.1 * (i % 4), 1.5 * (i / 6));
        person.yaw += i;
        person.scale *= 0.8 + 0.03 * i;
        std::swap(person.palette[scene::shirt_slot],
                  i % 2 == 0 ? person.palette[scene::hair_slot] : person.palette[scene::trousers_slot]);
        group.push_back(person);
    }
    const Person middle = sitter(*plain, 0, 0);
    for (const double azimuth : {0.0, 2.0, 4.0})
        for (const double distance : {3.0, 7.0, 25.0})
            expect_alike(renderer, models, group, camera(middle, azimuth, 0.3, distance), 4, "a group");
}

// Taller, wider, smaller and larger than before, and of odd sides.
TEST_F(Portrait, OfAnySizeIsTheReferences) {
    const std::unique_ptr<Model> model = harlequin(true);
    render::gl::Renderer renderer(nothing, {}, {}, std::vector{model->product()}, width, height);
    const Person person = sitter(*model, 0, 5);
    for (const glm::ivec2 size : {glm::ivec2(331, 90), {90, 331}, {37, 31}, {402, 301}, {200, 160}}) {
        size_ = size;
        renderer.resize(size.x, size.y);
        expect_alike(renderer, {model.get()}, {person}, camera(person, 0.4, 0.2, 2.5), 0,
                     std::to_string(size.x) + "x" + std::to_string(size.y));
    }
}

// Whoever is tall or small, and whatever their file's unit.
TEST_F(Portrait, SplatsAreNoWiderThanWhomTheyBelongTo) {
    for (const float unit : {1.0f, 0.2f}) {
        model::Character character = reference::make_harlequin(false);
        character.clips.clear();
        for (glm::vec3& position : character.mesh.positions) position *= unit;
        for (model::MorphTarget& morph : character.mesh.morphs)
            for (glm::vec3& offset : morph.position_offsets) offset *= unit;
        const Model model(std::move(character), {}, 100);
        render::gl::Renderer renderer(nothing, {}, {}, std::vector{model.product()}, width, height);
        for (const std::size_t points : {2u, 6u, 24u, 96u}) {
            for (const double distance : {12.0, 30.0}) {
                Person person = sitter(model, 0, 0);
                person.points = points;
                expect_alike(renderer, {&model}, {person}, camera(person, 1, 0.2, distance), 32,
                             std::to_string(points) + " points from " + std::to_string(distance) + " m");
            }
        }
    }
}

// Of stripes finer than a device's texture their mean is left.
TEST_F(Portrait, OfTooFineTexturesIsTheReferences) {
    model::Character character = reference::make_harlequin(false);
    for (const bool columns : {false, true}) {
        model::Texture& stripes = character.mesh.textures[columns];
        stripes = {columns ? 2048 : 2, columns ? 2 : 2048, {}};
        for (int i = 0; i < 2 * 2048; ++i)
            stripes.texels.push_back((columns ? i : i / 2) % 2 == 0 ? glm::u8vec4(250, 80, 90, 255)
                                                                    : glm::u8vec4(90, 200, 60, 255));
    }
    const Model model(std::move(character), {0, 1}, 100);
    render::gl::Renderer renderer(nothing, {}, {}, std::vector{model.product()}, width, height);
    const Person person = sitter(model, 0, 0);
    for (const double azimuth : {0.3, 2.5, 4.5})
        expect_alike(renderer, {&model}, {person}, camera(person, azimuth, 0.2, 2), 0, "striped");
}

// Of stripes that a device's texture has room for, each is seen from close enough.
TEST_F(Portrait, OfFineTexturesKeepsTheirStripes) {
    least_plain_share_ = 0.2;  // half floats tell coordinates to half a texel
    model::Character character = reference::make_harlequin(false);
    for (model::Texture& stripes : character.mesh.textures) {
        stripes = {1000, 2, {}};
        for (int i = 0; i < 2 * 1000; ++i)
            stripes.texels.push_back(i / 5 % 2 == 0 ? glm::u8vec4(250, 80, 90, 255) : glm::u8vec4(90, 200, 60, 255));
    }
    const Model model(std::move(character), {0, 1}, 100);
    render::gl::Renderer renderer(nothing, {}, {}, std::vector{model.product()}, width, height);
    const Person person = sitter(model, 0, 0);
    for (const double azimuth : {0.3, 2.5, 4.5}) {
        scene::CameraPose pose = camera(person, azimuth, 0.2, 2);
        pose.target = person.origin + person.scale * glm::dvec3(0, 1.55, 0);  // the head
        pose.fov_y = 0.02;
        expect_alike(renderer, {&model}, {person}, pose, 0, "finely striped");
    }
}

// Walls are seen from one side, beside whoever is seen from both.
TEST_F(Portrait, OfAnOpenFigureLeavesWallsOneSided) {
    const std::unique_ptr<Model> model = harlequin(true);
    const Person person = sitter(*model, 0, 0);
    scene::StaticMesh walls;
    for (const float side : {-1.0f, 1.0f}) {
        const auto first = static_cast<std::uint32_t>(walls.vertices.size());
        const glm::vec3 foot = glm::vec3(person.origin) + glm::vec3(1.5f * side, 0, 0.2f);
        for (const glm::vec3 corner : {glm::vec3(0), {0, 0, 1}, {0, 1.5f, 0}})
            walls.vertices.push_back({foot + corner, {-side, 0, 0}, {200, 120, 60, 0}});
        const bool turned = side > 0;
        for (const std::uint32_t i : {0u, turned ? 1u : 2u, turned ? 2u : 1u}) walls.indices.push_back(first + i);
    }
    walls.sectors.push_back({{glm::vec3(person.origin) - 3.0f, glm::vec3(person.origin) + 3.0f}, 0, 6});
    structure_ = &walls;
    render::gl::Renderer renderer(walls, {}, {}, std::vector{model->product()}, width, height);
    for (int side = 0; side < 6; ++side)
        expect_alike(renderer, {model.get()}, {person}, camera(person, side + 0.2, 0.2, 5), 0, "between walls");
}

TEST_F(Portrait, OfThePersonIsTheReferences) {
    expect_alike_all_around(*built_in());
}
TEST_F(Portrait, OfAHarlequinIsTheReferences) {
    expect_alike_all_around(*harlequin(false));
}
TEST_F(Portrait, OfAnOpenHarlequinIsTheReferences) {
    expect_alike_all_around(*harlequin(true));
}
TEST_F(Portrait, OfAMaskedHarlequinIsTheReferences) {
    expect_alike_all_around(Model(reference::make_masked_harlequin(), {0, 1}, 800));
}
TEST_F(Portrait, OfThePersonIsTheReferencesByAnyNumberOfPoints) {
    expect_alike_by_every_number_of_points(*built_in());
}
TEST_F(Portrait, OfAHarlequinIsTheReferencesByAnyNumberOfPoints) {
    expect_alike_by_every_number_of_points(*harlequin(false));
}
TEST_F(Portrait, OfAnOpenHarlequinIsTheReferencesByAnyNumberOfPoints) {
    expect_alike_by_every_number_of_points(*harlequin(true));
}

}  // namespace
