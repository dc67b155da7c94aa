#!/usr/bin/env bash
# Sticks that are not there, around an unmodified program.
set -u
starbow=$1 rig=$2
