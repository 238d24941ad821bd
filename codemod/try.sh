cd /work/wt/names && git reset -q --hard && git clean -fdq src tests benches docs && python3 /tmp/codemod/apply.py . "$@" 2>&1 | tail -${TAIL:-12}
export CARGO_TARGET_DIR=/work/tgt/names
cargo check --workspace --all-targets --locked --offline --message-format=short 2>&1 | grep -E '(error|warning)' | head -${HEAD:-60}
