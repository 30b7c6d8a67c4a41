#pragma once

namespace ballbot::test {

// What the test of the seams adds to the program, one file each; docs/adding.md is made of them.
void addDriveThermometer();
void addLeanTask();
void addGentleLaw();

}  // namespace ballbot::test
