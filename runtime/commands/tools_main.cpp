#include "commands.h"

int main(int count, char** arguments)
{
    using namespace starbow;
    return run_program(count, arguments, {add_bench, add_measure, add_soak, add_reference});
}
