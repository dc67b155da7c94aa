#include "challenge_sheet.h"
#include "config/markup/html.h"
#include <sstream>

namespace starbow {
namespace {

std::string start_of(const Challenge& challenge)
{
    return std::string("starbow run ") + challenge.start + " --log GROUP1.csv";
}

std::string hint_name(std::size_t i, const Words& words)
{
    return words("challenge.hint", {{"number", std::to_string(i + 1)}});
}

} // namespace

std::string challenge_text(const Challenge& challenge, int hints, const Words& words)
{
    std::string text = std::string(challenge.name) + ": " + words(challenge.title) + "\n" + words(challenge.ask) + "\n"
        + words("challenge.start") + ": " + start_of(challenge) + "\n" + words("challenge.tools") + ": "
        + words(challenge.tools) + "\n" + words("challenge.check") + ": " + words(challenge.check) + "\n";
    for (std::size_t i = 0; i < challenge.hints.size() && int(i) < hints; ++i)
        text += hint_name(i, words) + ": " + words(challenge.hints[i]) + "\n";
    return text;
}

std::string challenge_sheet(const Words& words)
{
    std::ostringstream out;
    out << page_begin(words.language, words("challenge.sheet"),
        "h2 code{font-weight:normal;font-size:.8em;color:#555}.ask{font-size:1.1em}dt{font-weight:bold}"
        "section{break-inside:avoid}details{margin:.3rem 0}")
        << "<h1>" << escaped_html(words("challenge.sheet")) << "</h1>\n<p>" << escaped_html(words("challenge.sheet_intro"))
        << "</p>\n";
    int number = 0;
    for (const Challenge& challenge : challenges()) {
        const auto item = [&](Key name, const std::string& text) {
            out << "<dt>" << escaped_html(words(name)) << "</dt><dd>" << text << "</dd>\n";
        };
        out << "<section><h2>" << ++number << ". " << escaped_html(words(challenge.title)) << " <code>" << challenge.name
            << "</code></h2>\n<p class=\"ask\">" << escaped_html(words(challenge.ask)) << "</p>\n<dl>";
        item("challenge.start", "<code>" + escaped_html(start_of(challenge)) + "</code>");
        item("challenge.tools", escaped_html(words(challenge.tools)));
        item("challenge.check", escaped_html(words(challenge.check)));
        out << "</dl>\n";
        for (std::size_t i = 0; i < challenge.hints.size(); ++i)
            out << "<details><summary>" << escaped_html(hint_name(i, words)) << "</summary>"
                << escaped_html(words(challenge.hints[i])) << "</details>\n";
        out << "</section>\n";
    }
    out << "</body></html>\n";
    return out.str();
}

} // namespace starbow
