#include "parts.h"
#include <zip.h>

namespace starbow {
namespace {

constexpr std::size_t mib = std::size_t(1) << 20;

zip_t* handle(void* zip) { return static_cast<zip_t*>(zip); }

} // namespace

// A vertex takes eight times the bytes that it has in a PFM.
std::size_t most_memory(std::size_t archive_bytes) { return archive_bytes < mib ? 60 * mib : 512 * archive_bytes; }
std::size_t most_inflated(std::size_t archive_bytes) { return archive_bytes < mib ? 7 * mib : 64 * archive_bytes; }

Archive::Archive(const WarpFile& file)
    : file_(file)
{
    zip_error_t error;
    zip_error_init(&error);
    const auto fail = [&](const std::string& what) {
        const std::string why = zip_error_strerror(&error);
        zip_error_fini(&error);
        refuse(file, "", "can't be read as a zip archive (" + what + why + "); an MPCDI archive is right");
    };
    zip_source_t* source = zip_source_buffer_create(file.content.data(), file.content.size(), 0, &error);
    if (!source)
        fail("");
    zip_ = zip_open_from_source(source, ZIP_RDONLY, &error);
    if (!zip_) {
        zip_source_free(source);
        fail("");
    }
    zip_error_fini(&error);
    const zip_int64_t count = zip_get_num_entries(handle(zip_), 0);
    if (count > 4096) {
        zip_discard(handle(zip_));
        refuse(file, "", "holds " + std::to_string(count) + " files; at most 4096 are right");
    }
    for (zip_int64_t i = 0; i < count; ++i)
        if (const char* name = zip_get_name(handle(zip_), zip_uint64_t(i), 0);
            name && *name && std::string_view(name).back() != '/')
            names_.emplace_back(name);
}

Archive::~Archive() { zip_discard(handle(zip_)); }

std::string Archive::contents(const std::string& name, std::size_t most_bytes) const
{
    const zip_int64_t index = zip_name_locate(handle(zip_), name.c_str(), ZIP_FL_NOCASE);
    if (index < 0)
        refuse(file_, name, "is not in the archive; a file that is there is right");
    struct Closer {
        zip_file_t* entry;
        ~Closer() { zip_fclose(entry); }
    };
    zip_file_t* entry = zip_fopen_index(handle(zip_), zip_uint64_t(index), 0);
    if (!entry)
        refuse(file_, name,
            std::string("can't be unpacked (") + zip_strerror(handle(zip_))
                + "); a file packed by deflate, not encrypted, is right");
    const Closer closer{entry};
    // In pieces: the size that the archive announces may be anything.
    std::string bytes;
    char piece[16384];
    zip_int64_t got = 0;
    while ((got = zip_fread(entry, piece, sizeof piece)) > 0) {
        if (bytes.size() + std::size_t(got) > most_bytes)
            refuse(file_, name,
                "unpacks to more than " + std::to_string(most_bytes) + " bytes; less is right for an archive of "
                    + std::to_string(file_.content.size()));
        bytes.append(piece, std::size_t(got));
    }
    if (got < 0)
        refuse(file_, name, std::string("is damaged (") + zip_file_strerror(entry) + "); a whole archive is right");
    return bytes;
}

} // namespace starbow
