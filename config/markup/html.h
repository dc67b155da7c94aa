#pragma once
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace starbow {

/// A foreign text as text or an attribute of HTML and SVG. Control characters, which XML forbids, become question marks.
inline std::string escaped_html(const std::string& text)
{
    std::string out;
    for (char c : text)
        if (c == '<' || c == '>')
            out += c == '<' ? "&lt;" : "&gt;";
        else if (c == '&' || c == '"')
            out += c == '&' ? "&amp;" : "&quot;";
        else
            out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
    return out;
}

/// A row of a table; the cells' texts may have any letters. cell: "td", or "th" for the head.
inline std::string table_row(std::initializer_list<std::string> texts, const std::string& cell = "td")
{
    std::string row = "<tr>";
    for (const std::string& text : texts)
        row += "<" + cell + ">" + escaped_html(text) + "</" + cell + ">";
    return row + "</tr>\n";
}

/// A PNG file's bytes as an image's source, so that a page is one file.
inline std::string png_source(const std::vector<unsigned char>& png)
{
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out = "data:image/png;base64,";
    for (std::size_t i = 0; i < png.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(png.size() - i, 3);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < left ? png[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= left ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

/// The style of all written pages.
inline constexpr const char* page_style
    = "body{font:16px/1.5 sans-serif;color:#1a1a1a;background:#fff;max-width:56rem;margin:2rem auto;padding:0 1rem}"
      "h1{font-size:1.5rem}h2{font-size:1.1rem;margin-top:2rem}table{border-collapse:collapse}"
      "td,th{padding:.2rem .8rem;text-align:right;border-bottom:1px solid "
      "#ddd}td:first-child,th:first-child{text-align:left}"
      "svg{width:100%;height:auto}text{font:12px sans-serif;fill:#333}";

/// The beginning of a page up to its heading, which is the title. style: added to page_style.
inline std::string page_begin(const std::string& language, const std::string& title, const std::string& style = "")
{
    return "<!doctype html>\n<html lang=\"" + language
        + "\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>"
        + escaped_html(title) + "</title><style>" + page_style + style + "</style></head><body>\n";
}

} // namespace starbow
