import sys,subprocess,collections,re
sys.path.insert(0,'/tmp/codemod')
from rust_tokens import tokens
root='/work/wt/names'; words=set(sys.argv[1].split(','))
for f in subprocess.run(['git','-C',root,'ls-files','*.rs'],capture_output=True,text=True).stdout.split():
    c=collections.Counter()
    for k,t in tokens(open(f'{root}/{f}').read()):
        if k=='ident' and t in words: c[t]+=1
        elif k in('str','comment'):
            for w in re.findall(r'[A-Za-z_]+',t):
                if w in words: c[k+':'+w]+=1
    if c: print(f, dict(c))
