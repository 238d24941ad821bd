#!/usr/bin/env python3
"""Writes a folder of three small Moving AI maps with their scenarios, and a floor plan as a PNG image.

The maps are drawn from a written seed: a cave, rooms, pillars. Optimal lengths come from Dijkstra's algorithm in exact integers (straight,
diagonal), written here and sharing no code with replan: no corner is cut, as the benchmark's own lengths assume. Formats: N. Sturtevant,
Benchmarks for Grid-Based Pathfinding, IEEE T-CIAIG 4(2), 2012; y counts downwards.
"""
import heapq
import pathlib
import random
import struct
import zlib

HERE = pathlib.Path(__file__).parent
QUERIES = 40


def cave(rng, side):
    rows = [[rng.random() < 0.42 for _ in range(side)] for _ in range(side)]
    for _ in range(4):
        near = lambda x, y: sum(
            not (0 <= a < side and 0 <= b < side) or rows[b][a]
            for a in (x - 1, x, x + 1)
            for b in (y - 1, y, y + 1)
        )
        rows = [[near(x, y) >= 5 for x in range(side)] for y in range(side)]
    return rows


def rooms(rng, side):
    rows = [[x % 9 == 8 or y % 9 == 8 for x in range(side)] for y in range(side)]
    for y in range(0, side, 9):
        for x in range(0, side, 9):
            if x + 8 < side:
                rows[min(side - 1, y + rng.randrange(8))][x + 8] = False
            if y + 8 < side:
                rows[y + 8][min(side - 1, x + rng.randrange(8))] = False
    return rows


def pillars(rng, side):
    return [[x % 4 == 1 and y % 4 == 1 or rng.random() < 0.06 for x in range(side)] for y in range(side)]


def lengths(rows, start):
    """Length of the shortest path from start to every cell that can be reached."""
    side = len(rows)
    free = lambda x, y: 0 <= x < side and 0 <= y < side and not rows[y][x]
    done, queue = {}, [(0.0, 0, 0, start)]
    while queue:
        length, straight, diagonal, (x, y) = heapq.heappop(queue)
        if (x, y) in done:
            continue
        done[(x, y)] = length
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                to = (x + dx, y + dy)
                if (dx, dy) == (0, 0) or to in done or not free(*to):
                    continue
                if dx and dy and not (free(x + dx, y) and free(x, y + dy)):
                    continue
                s, d = straight + (not (dx and dy)), diagonal + bool(dx and dy)
                heapq.heappush(queue, (s + d * 2**0.5, s, d, to))
    return done


def write_map(name, rows, rng):
    side = len(rows)
    ground = [(x, y) for y in range(side) for x in range(side) if not rows[y][x]]
    queries = []
    while len(queries) < QUERIES:
        start, goal = rng.choice(ground), rng.choice(ground)
        length = lengths(rows, start).get(goal)
        if length:
            queries.append((length, start, goal))
    queries.sort()
    cells = "\n".join("".join("@" if cell else "." for cell in row) for row in rows)
    (HERE / f"{name}.map").write_text(f"type octile\nheight {side}\nwidth {side}\nmap\n{cells}\n")
    lines = [
        f"{int(length / 4)}\t{name}.map\t{side}\t{side}\t{sx}\t{sy}\t{gx}\t{gy}\t{length:.8f}"
        for length, (sx, sy), (gx, gy) in queries
    ]
    (HERE / f"{name}.map.scen").write_text("version 1\n" + "\n".join(lines) + "\n")


def floor_plan():
    """Rooms around a corridor, walls black; the length printed is the oracle of study `image`."""
    width, height = 60, 40
    walls = [[x in (0, width - 1) or y in (0, height - 1) for x in range(width)] for y in range(height)]
    for x in range(width):
        walls[16][x] = walls[16][x] or x not in (10, 11, 30, 31, 50, 51)
        walls[23][x] = walls[23][x] or x not in (20, 21, 44, 45)
    for y in list(range(16)) + list(range(24, height)):
        walls[y][20 if y < 16 else 30] = True
        walls[y][40] = walls[y][40] or y < 16
    pixels = b"".join(b"\0" + bytes(0 if wall else 255 for wall in row) for row in walls)
    parts = (
        (b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)),
        (b"IDAT", zlib.compress(pixels, 9)),
        (b"IEND", b""),
    )
    chunks = [struct.pack(">I", len(b)) + k + b + struct.pack(">I", zlib.crc32(k + b)) for k, b in parts]
    (HERE / "floor.png").write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(chunks))
    # Start and goal of the study have y up.
    side = max(width, height)
    square = [row + [True] * (side - width) for row in walls] + [[True] * side] * (side - height)
    print("floor.png, (5, 35) to (55, 4):", lengths(square, (5, height - 1 - 35))[(55, height - 1 - 4)])


def main():
    rng = random.Random(22)
    for name, draw in (("cave", cave), ("pillars", pillars), ("rooms", rooms)):
        write_map(name, draw(rng, 48), rng)
    floor_plan()


main()
