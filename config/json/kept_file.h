#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

namespace starbow {

/// The name of a cache's file by its content's key.
inline std::string kept_name(std::uint64_t key, const char* ending)
{
    char name[32];
    std::snprintf(name, sizeof name, "%016llx%s", static_cast<unsigned long long>(key), ending);
    return name;
}

/// Marks a cache's file as just read, so that others are deleted first.
inline void mark_as_read(const std::filesystem::path& file)
{
    std::error_code ignored;
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), ignored);
}

} // namespace starbow
