#pragma once
#include "config/json/reader.h"
#include "remote_file.h"

namespace starbow {

/// Reads an exhibit's "remote". Paths in it start at `folder`. Throws InputError.
RemoteSettings read_remote(const Place& place, const std::filesystem::path& folder);

} // namespace starbow
