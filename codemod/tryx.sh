# on the branch of choices (or whatever the worktree namesx stands at)
cd /work/wt/namesx && git reset -q --hard && git clean -fdq src tests benches docs && python3 /tmp/codemod/apply.py . "$@" 2>&1 | grep -v nothing | tail -${TAIL:-12}
export CARGO_TARGET_DIR=/work/tgt/names
[ -n "$NOCHECK" ] || cargo check --workspace --all-targets --locked --offline --message-format=short 2>&1 | grep -E '(error|warning)' | head -${HEAD:-60}
