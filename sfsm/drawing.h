// By what frames are drawn. What work is believed to cost depends on it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace sfsm {

enum class Drawing : int {
    opengl,  // by a device, or a driver that stands for one
    native,  // by the renderer's own code on the processor
};

// As the setting `draw` of a trace has them, in the order of Drawing.
inline constexpr auto drawing_names = std::to_array<std::string_view>({"gl", "native"});
inline constexpr std::size_t drawings = drawing_names.size();

constexpr std::size_t index_of(Drawing drawing) {
    return static_cast<std::size_t>(drawing);
}

constexpr std::string_view name_of(Drawing drawing) {
    return drawing_names[index_of(drawing)];
}

constexpr std::optional<Drawing> drawing_named(std::string_view name) {
    for (std::size_t i = 0; i < drawings; ++i)
        if (drawing_names[i] == name) return static_cast<Drawing>(i);
    return std::nullopt;
}

}  // namespace sfsm
