#pragma once
#include <dirent.h>
#include <filesystem>
#include <memory>
#include <string_view>

namespace starbow {

/// Calls each(name) for all that is in a folder, in any order; not at all where it can't be read. The iterators of
/// std::filesystem end the program where memory lacks, so that nothing in flight may use them.
template <class Each> void each_entry(const std::filesystem::path& folder, Each&& each)
{
    const std::unique_ptr<DIR, int (*)(DIR*)> open(opendir(folder.c_str()), closedir);
    while (const dirent* const entry = open ? readdir(open.get()) : nullptr)
        if (const std::string_view name = entry->d_name; name != "." && name != "..")
            each(entry->d_name);
}

} // namespace starbow
