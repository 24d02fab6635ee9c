// Prints the version of the Seiche that was found.
#include <seiche/version.hpp>

#include <iostream>

int main() { std::cout << seiche::version_number << '\n'; }
