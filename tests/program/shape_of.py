#!/usr/bin/env python3
"""Measures the shape of a mesh file: python3 shape_of.py MESH.2dm|MESH.obj

Prints the number of triangles, the smallest angle in degrees, the shortest and the longest edge, seen from above.
"""
import math
import sys

nodes, triangles = {}, []
for line in open(sys.argv[1]):
    word = line.split()
    if word and word[0] == "ND":
        nodes[int(word[1])] = tuple(map(float, word[2:4]))
    elif word and word[0] == "E3T":
        triangles.append(tuple(map(int, word[2:5])))
    elif word and word[0] == "v":
        nodes[len(nodes) + 1] = tuple(map(float, word[1:3]))
    elif word and word[0] == "f":
        triangles.append(tuple(int(v.split("/")[0]) for v in word[1:4]))
smallest, shortest, longest = 180.0, math.inf, 0.0
for t in triangles:
    p = [nodes[v] for v in t]
    sides = [math.dist(p[(k + 1) % 3], p[(k + 2) % 3]) for k in range(3)]
    shortest, longest = min(shortest, *sides), max(longest, *sides)
    for k in range(3):
        b, c = sides[(k + 1) % 3], sides[(k + 2) % 3]
        smallest = min(smallest, math.degrees(math.acos(max(-1, min(1, (b * b + c * c - sides[k] ** 2) / (2 * b * c))))))
print(len(triangles), f"{smallest:.6f} {shortest:.9g} {longest:.9g}")
