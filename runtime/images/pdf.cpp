#include "pdf.h"
#include "config/json/error.h"
#include "config/json/other_program.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"

namespace starbow {
namespace fs = std::filesystem;

void write_pdf(const fs::path& file, const std::string& page)
{
    const Ended ended = make_whole(file, [&](const fs::path& part) {
        fs::path source = part;
        source += ".html";
        write_whole(source, page);
        Ended program = ran({"weasyprint", "--quiet", source.string(), part.string()}, part.parent_path());
        std::error_code ignored;
        fs::remove(source, ignored);
        return program;
    });
    if (ended.status != 0)
        throw InputError(one_line(file.string()), "",
            "weasyprint could not make it (" + how(ended)
                + "); Debian's package weasyprint, installed, is right, or a name that ends in .html, for a page that a "
                  "browser prints");
}

} // namespace starbow
