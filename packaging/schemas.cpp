// Writes the JSON schemas of all kinds of files into a folder, for editors; a file that is right already keeps its time.
#include "config/json/whole_file.h"
#include "config/model/schemas.h"
#include <cstdio>
#include <filesystem>

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::fprintf(stderr, "Usage: starbow_schemas FOLDER      Example: starbow_schemas config/schema\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    for (const std::string& kind : starbow::kinds_with_schema()) {
        const std::filesystem::path file = folder / (kind + ".schema.json");
        const std::string text = starbow::schema_text(kind);
        if (!exists(file) || starbow::read_whole(file, 1 << 24, "a schema") != text)
            starbow::write_whole(file, text);
    }
}
