#!/usr/bin/env python3
"""apply.py [ROOT] [--only STAGE,STAGE]: renames words, types and functions across the tree and splits lets of unrelated things.

Deterministic, no network, safe to apply twice: every rule asks for what it renames. Stages run in the order below.
"""
import subprocess, sys
sys.path.insert(0, '/tmp/codemod')
from engine import Tree
import tuple_lets, types_rules, glossary_rules, spec_rules, reading_rules, renamed_stage

def tuples(tree):
    n = 0
    for f in tree.match('**/*.rs') + tree.match('*.rs'):
        text, c = tuple_lets.transform(tree.read(f))
        n += c
        tree.write(f, text)
    print(f'tuple lets split: {n}')

STAGES = [('tuples', tuples), ('types', types_rules.apply), ('glossary', glossary_rules.apply), ('specs', spec_rules.apply), ('readings', reading_rules.apply), ('renamed', renamed_stage.apply)]

if __name__ == '__main__':
    args = [a for a in sys.argv[1:] if not a.startswith('--')]
    root = args[0] if args else '.'
    only = [a.split('=')[1].split(',') for a in sys.argv if a.startswith('--only=')]
    tree = Tree(root)
    for name, stage in STAGES:
        if not only or name in only[0]:
            stage(tree)
            tree.save()
    rust = [f for f in tree.files if f.endswith('.rs')]
    subprocess.run(['rustfmt', '--edition', '2024', '--config-path', f'{root}/rustfmt.toml'] + [f'{root}/{f}' for f in rust])
