#pragma once
#include "config/model/one_view.h"
#include "displays/compile/compiled_view.h"

namespace starbow::testing {

/// Compiles a display of one view as an exhibit does.
inline CompiledView view_of(const Projection& projection, glm::ivec2 size)
{
    MapStore store{std::filesystem::path()};
    return compile_output(store, one_view(projection, size), 0, size).front();
}

} // namespace starbow::testing
