#include "commands.h"

int main(int count, char** arguments) { return starbow::run_program(count, arguments); }
