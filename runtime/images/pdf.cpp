#include "pdf.h"
#include "config/json/error.h"
#include "config/json/other_program.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include <unistd.h>

namespace starbow {
namespace fs = std::filesystem;

void write_pdf(const fs::path& file, const std::string& page)
{
    const fs::path whole = fs::absolute(file).lexically_normal();
    fs::path source = whole, part = whole;
    source += '.' + std::to_string(getpid()) + ".html", part += '.' + std::to_string(getpid()) + ".pdf";
    write_whole(source, page);
    const Ended ended = ran({"weasyprint", "--quiet", source.string(), part.string()}, whole.parent_path());
    std::error_code error;
    fs::remove(source, error);
    if (ended.status == 0)
        fs::rename(part, whole, error);
    if (ended.status == 0 && !error)
        return;
    const int why = error.value();
    fs::remove(part, error);
    if (ended.status == 0)
        refuse_writing(file, why);
    throw InputError(one_line(file.string()), "",
        "weasyprint could not make it (" + how(ended)
            + "); Debian's package weasyprint, installed, is right, or a name that ends in .html, for a page that a browser "
              "prints");
}

} // namespace starbow
