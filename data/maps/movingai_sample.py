#!/usr/bin/env python3
"""Writes movingai_sample.map and movingai_sample.scen, a small map in the MovingAI format with its queries.

The map is drawn from a written seed. Optimal lengths come from Dijkstra's algorithm in exact integers (straight,
diagonal), written here and sharing no code with replan: no corner is cut, as the benchmark's own lengths assume.
Formats: N. Sturtevant, Benchmarks for Grid-Based Pathfinding, IEEE T-CIAIG 4(2), 2012; y counts downwards.
"""
import heapq
import pathlib
import random

WIDTH, HEIGHT, QUERIES = 48, 32, 60
FREE = ".GS"
HERE = pathlib.Path(__file__).parent


def drawn(rng):
    rows = [["."] * WIDTH for _ in range(HEIGHT)]
    for letter, count in (("@", 14), ("T", 10), ("W", 5), ("O", 4), ("G", 8), ("S", 6)):
        for _ in range(count):
            left, top = rng.randrange(WIDTH), rng.randrange(HEIGHT)
            for y in range(top, min(HEIGHT, top + rng.randint(1, 7))):
                for x in range(left, min(WIDTH, left + rng.randint(1, 7))):
                    rows[y][x] = letter
    return ["".join(row) for row in rows]


def lengths(rows, start):
    """Length of the shortest path from start to every cell that can be reached."""
    free = lambda x, y: 0 <= x < WIDTH and 0 <= y < HEIGHT and rows[y][x] in FREE
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


def main():
    rng = random.Random(2012)
    rows = drawn(rng)
    ground = [(x, y) for y in range(HEIGHT) for x in range(WIDTH) if rows[y][x] in FREE]
    queries = []
    while len(queries) < QUERIES:
        start, goal = rng.choice(ground), rng.choice(ground)
        length = lengths(rows, start).get(goal)
        if length:
            queries.append((length, start, goal))
    queries.sort()
    name = "movingai_sample.map"
    (HERE / name).write_text(f"type octile\nheight {HEIGHT}\nwidth {WIDTH}\nmap\n" + "\n".join(rows) + "\n")
    lines = [
        f"{int(length / 4)}\t{name}\t{WIDTH}\t{HEIGHT}\t{sx}\t{sy}\t{gx}\t{gy}\t{length:.8f}"
        for length, (sx, sy), (gx, gy) in queries
    ]
    (HERE / "movingai_sample.scen").write_text("version 1\n" + "\n".join(lines) + "\n")


main()
